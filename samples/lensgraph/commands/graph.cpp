// lensgraph graph: the compiled render graph of a shot and a technique, for Graphviz or as JSON.
#include "rendergraph/graph.h"

#include <array>
#include <cstdio>
#include <sstream>

#include "rendergraph/dump.h"
#include "samples/host/raytraced.h"
#include "samples/lensgraph/output.h"
#include "samples/lensgraph/session.h"
#include "samples/lensgraph/subcommands.h"

namespace lensgraph::cli {

int runGraph(const GraphArguments& arguments, const GlobalArguments& global) {
  host::Shot shot = host::readShot(arguments.shot);
  if (arguments.size) {
    shot.width = arguments.size->width;
    shot.height = arguments.size->height;
  }
  shot.faces = arguments.faces.value_or(shot.faces);
  const auto choice = chooseTechnique({shot.technique, shot.parameters}, arguments.technique);
  if (host::isRaytraced(choice.name)) host::failWithoutGraph("--technique", "nothing to write");
  if (arguments.dot && *arguments.dot != "-") checkOutput(*arguments.dot, "--dot");
  if (arguments.json && *arguments.json != "-") checkOutput(*arguments.json, "--json");
  const std::array<OutputFile, 2> files = {OutputFile{arguments.dot.value_or(""), "--dot"},
                                           OutputFile{arguments.json.value_or(""), "--json"}};
  requireDistinct(files);

  Session session(global);
  std::vector<std::string> warnings;
  host::Renderer renderer(session.device(), shot, warnings);
  Session::report(warnings);

  const host::RenderOptions options{
      .technique = choice.name, .parameters = choice.parameters, .execute = {}, .wantDepth = false, .progress = {}};
  rendergraph::Graph graph;
  renderer.declare(graph, shot, options);
  const auto plan = renderer.compile(graph, options.execute.compile);
  const auto write = [&](const std::optional<std::filesystem::path>& file, auto dump) {
    if (!file) return;
    std::ostringstream text;
    dump(text, graph, plan);
    writeTextFile(*file, text.str());
  };
  write(arguments.dot, [](auto&... all) { rendergraph::writeDot(all...); });
  write(arguments.json, [](auto&... all) { rendergraph::writeJson(all...); });
  // stdout may be the graph itself.
  std::fprintf(stderr, "lensgraph: device %s\n", describe(session.device().description()).c_str());
  return session.finish();
}

}  // namespace lensgraph::cli
