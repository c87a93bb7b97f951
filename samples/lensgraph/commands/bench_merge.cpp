// lensgraph bench-merge: the parts of a benchmark, measured with --shard, as one.
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "engine/error.h"
#include "engine/files/output_file.h"
#include "samples/lensgraph/bench/results/bench_file.h"
#include "samples/lensgraph/commands/bench_output.h"
#include "samples/lensgraph/subcommands.h"

namespace lensgraph::cli {
namespace {

using nlohmann::ordered_json;
using std::filesystem::path;

/// What must be the same in all parts, as pointers into bench.json.
constexpr const char* kShared[] = {"/name", "/settings", "/programs", "/device"};

struct Part {
  path folder;
  ordered_json document;
  int index = 0, count = 0;
};

Part readPart(const path& folder) {
  Part part{folder, readBenchFile(folder), 0, 0};
  const std::string shard = part.document.value("shard", "1/1");
  if (std::sscanf(shard.c_str(), "%d/%d", &part.index, &part.count) != 2) {
    throw engine::Error(
        {.file = (folder / "bench.json").string(), .field = "shard", .reason = "is no I/N", .remedy = ""});
  }
  return part;
}

void requireLike(const Part& first, const Part& part) {
  const auto fail = [&](const std::string& field) {
    throw engine::Error({.file = (part.folder / "bench.json").string(),
                         .field = field,
                         .reason = "is not that of " + (first.folder / "bench.json").string(),
                         .remedy = "give the parts of one benchmark"});
  };
  for (const std::string pointer : kShared) {
    const ordered_json::json_pointer at(pointer);
    if (first.document[at] != part.document[at]) fail(pointer.substr(1));
  }
  if (first.count != part.count) fail("shard");
}

/// Parts by their index. Throws when one is missing, there twice, or of another benchmark.
std::map<int, Part> readParts(const std::vector<path>& folders) {
  std::map<int, Part> parts;
  for (const auto& folder : folders) {
    Part part = readPart(folder);
    if (!parts.empty()) requireLike(parts.begin()->second, part);
    const int index = part.index;
    const std::string name = part.document.value("shard", "");
    if (!parts.emplace(index, std::move(part)).second) {
      throw engine::Error({.file = (folder / "bench.json").string(),
                           .field = "shard",
                           .reason = name + " is there twice",
                           .remedy = "leave one of them out"});
    }
  }
  const int count = parts.begin()->second.count;
  for (int index = 1; index <= count; ++index) {
    if (parts.contains(index)) continue;
    throw engine::Error({.file = "command line",
                         .field = "bench-merge",
                         .reason = "part " + std::to_string(index) + "/" + std::to_string(count) + " is missing",
                         .remedy = "give the folders of all parts"});
  }
  return parts;
}

void copyPicture(const Part& part, const ordered_json& name, const path& output) {
  if (!name.is_string()) return;
  const path file = name.get<std::string>();
  std::filesystem::create_directories((output / file).parent_path());
  std::ifstream stream(part.folder / file, std::ios::binary);
  if (!stream) {
    throw engine::Error({.file = (part.folder / file).string(), .field = {}, .reason = "no such file", .remedy = ""});
  }
  const std::string content(std::istreambuf_iterator<char>(stream), {});
  engine::writeFile(output / file, content);
}

/// Adds a part's results to the shot that they belong to; a part that comes later adds to the units of the first.
void addShot(ordered_json& shots, const ordered_json& shot) {
  for (auto& known : shots) {
    if (known["case"] != shot["case"]) continue;
    for (const auto& result : shot["results"]) known["results"].push_back(result);
    return;
  }
  shots.push_back(shot);
}

}  // namespace

int runBenchMerge(const BenchMergeArguments& arguments) {
  const auto parts = readParts(arguments.folders);
  ordered_json merged = parts.begin()->second.document;
  merged["shots"] = ordered_json::array();
  merged["hosts"] = ordered_json::array();
  merged.erase("shard");
  for (const auto& [index, part] : parts) {
    merged["hosts"].push_back(part.document["host"]);
    for (const auto& shot : part.document["shots"]) {
      addShot(merged["shots"], shot);
      copyPicture(part, shot["reference"]["picture"], arguments.output);
      for (const auto& mask : shot.value("maskPictures", ordered_json::object())) {
        copyPicture(part, mask, arguments.output);
      }
      for (const auto& result : shot["results"]) copyPicture(part, result["picture"], arguments.output);
    }
  }
  writeBench(merged, arguments.output);
  return 0;
}

}  // namespace lensgraph::cli
