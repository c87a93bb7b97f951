// Liveness from the observable ends backwards, and the reasons for what is left out.
#include "rendergraph/culling.h"

#include <string>

#include "rendergraph/cells.h"
#include "rendergraph/declaration.h"
#include "rendergraph/dependencies.h"

namespace rendergraph {

namespace {

std::vector<uint32_t> observableWriters(const Declaration& declaration, const Cells& cells, const DataFlow& flow) {
  std::vector<uint32_t> roots;
  for (uint32_t pass = 0; pass < declaration.passes.size(); ++pass) {
    if (declaration.passes[pass].sideEffect) roots.push_back(pass);
  }
  for (const DeclaredAccess& access : declaration.accesses) {
    if (access.writes() && !declaration.resources[access.resource].created()) roots.push_back(access.pass);
  }
  for (uint32_t resource = 0; resource < declaration.resources.size(); ++resource) {
    if (!declaration.resources[resource].exported) continue;
    const uint32_t first = cells.firstOf(resource);
    for (uint32_t cell = first; cell < first + cells.countOf(resource); ++cell) {
      if (flow.lastWriter[cell] != kNone) roots.push_back(flow.lastWriter[cell]);
    }
  }
  return roots;
}

std::string reasonFor(const Declaration& declaration, uint32_t pass, std::span<const Edge> consumers) {
  std::string reason;
  for (const DeclaredAccess& access : declaration.accessesOfPass(pass)) {
    if (!access.writes()) continue;
    const std::string name(declaration.resources[access.resource].name);
    std::string readers;
    for (const Edge& edge : consumers) {
      if (edge.resource != access.resource) continue;
      readers += (readers.empty() ? "'" : ", '") + std::string(declaration.passes[edge.to].name) + "'";
    }
    if (!reason.empty()) reason += "; ";
    reason += readers.empty() ? "nothing reads what it writes to '" + name + "'"
                              : "what it writes to '" + name + "' is read only by culled " + readers;
  }
  return reason.empty() ? "it writes nothing and has no declared side effect" : reason;
}

}  // namespace

Culling cull(const Declaration& declaration, const Cells& cells, const DataFlow& flow) {
  const auto passes = static_cast<uint32_t>(declaration.passes.size());
  Culling result;
  result.alive.assign(passes, 0);
  const Adjacency producers(flow.edges, passes, Adjacency::By::to);
  std::vector<uint32_t> waiting = observableWriters(declaration, cells, flow);
  while (!waiting.empty()) {
    const uint32_t pass = waiting.back();
    waiting.pop_back();
    if (result.alive[pass]) continue;
    result.alive[pass] = 1;
    for (const Edge& edge : producers.of(pass)) waiting.push_back(edge.from);
  }
  bool anyCulled = false;
  for (uint32_t pass = 0; pass < passes; ++pass) anyCulled = anyCulled || !result.alive[pass];
  if (!anyCulled) return result;
  const Adjacency consumers(flow.edges, passes, Adjacency::By::from);
  for (uint32_t pass = 0; pass < passes; ++pass) {
    if (!result.alive[pass]) result.culled.push_back({pass, reasonFor(declaration, pass, consumers.of(pass))});
  }
  return result;
}

}  // namespace rendergraph
