// lensgraph bench-merge: the parts of a benchmark, measured with --shard, as one.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/error.h"
#include "engine/files/output_file.h"
#include "samples/lensgraph/bench/bench_case.h"
#include "samples/lensgraph/bench/results/bench_file.h"
#include "samples/lensgraph/bench/results/json_values.h"
#include "samples/lensgraph/commands/bench_output.h"
#include "samples/lensgraph/output.h"
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
  Shard shard;
};

[[noreturn]] void failPart(const path& folder, const std::string& field, const std::string& reason,
                           const std::string& remedy) {
  throw engine::Error({.file = (folder / "bench.json").string(), .field = field, .reason = reason, .remedy = remedy});
}

Part readPart(const path& folder) {
  Part part{folder, readBenchFile(folder), {}};
  const auto text = valueAt(part.document, "/shard");
  const auto shard = text.is_string() ? shardFrom(text.get<std::string>()) : std::optional<Shard>();
  if (!shard) failPart(folder, "shard", "is no I/N", "give folders that lensgraph bench --shard wrote");
  part.shard = *shard;
  return part;
}

/// Whatever the order of their fields.
bool areSame(const nlohmann::json& one, const nlohmann::json& other) {
  return one == other;
}

void requireLike(const Part& first, const Part& part) {
  const auto fail = [&](const std::string& field) {
    failPart(part.folder, field, "is not that of " + (first.folder / "bench.json").string(),
             "give the parts of one benchmark");
  };
  for (const std::string pointer : kShared) {
    if (!areSame(valueAt(first.document, pointer), valueAt(part.document, pointer))) fail(pointer.substr(1));
  }
  if (first.shard.count != part.shard.count) fail("shard");
}

/// Parts by their index. Throws when one is missing, there twice, or of another benchmark.
std::map<int, Part> readParts(const std::vector<path>& folders) {
  std::map<int, Part> parts;
  for (const auto& folder : folders) {
    Part part = readPart(folder);
    if (!parts.empty()) requireLike(parts.begin()->second, part);
    const Shard shard = part.shard;
    if (!parts.emplace(shard.index, std::move(part)).second) {
      failPart(folder, "shard", nameOf(shard) + " is there twice", "leave one of them out");
    }
  }
  const int count = parts.begin()->second.shard.count;
  for (int index = 1; index <= count; ++index) {
    if (parts.contains(index)) continue;
    throw engine::Error({.file = "command line",
                         .field = "bench-merge",
                         .reason = "part " + nameOf({index, count}) + " is missing",
                         .remedy = "give the folders of all parts"});
  }
  return parts;
}

/// Whether the name stays below the folder that it is relative to.
bool isInside(const path& name) {
  return name.is_relative() && std::ranges::find(name, "..") == name.end();
}

void copyPicture(const Part& part, const ordered_json& name, const path& output) {
  if (!name.is_string()) return;
  const path file = name.get<std::string>();
  if (!isInside(file)) failPart(part.folder, "picture", "is outside the folder: " + file.string(), "");
  std::filesystem::create_directories((output / file).parent_path());
  std::ifstream stream(part.folder / file, std::ios::binary);
  if (!stream) {
    throw engine::Error({.file = (part.folder / file).string(), .field = {}, .reason = "no such file", .remedy = ""});
  }
  const std::string content(std::istreambuf_iterator<char>(stream), {});
  engine::writeFile(output / file, content);
}

/// Adds a part's results to the shot that they belong to. What the shot says of itself must be the same in all parts.
/// Units are those of the first; each result has its own part's in "unitMs".
void addShot(ordered_json& shots, const ordered_json& shot, const Part& part) {
  for (auto& known : shots) {
    if (known["case"] != shot["case"]) continue;
    for (const char* field : {"sceneHash", "width", "height", "reference", "masks", "accumulation"}) {
      if (areSame(valueAt(known, std::string("/") + field), valueAt(shot, std::string("/") + field))) continue;
      failPart(part.folder, shot["case"].get<std::string>() + "." + field, "is not that of the other parts",
               "measure the parts with the same scenes and references");
    }
    for (const auto& result : shot["results"]) known["results"].push_back(result);
    return;
  }
  shots.push_back(shot);
}

}  // namespace

int runBenchMerge(const BenchMergeArguments& arguments) {
  const auto parts = readParts(arguments.folders);
  makeOutputFolder(arguments.output, "--output", "bench.json");
  for (const auto& [index, part] : parts) {
    std::error_code code;
    if (!std::filesystem::equivalent(part.folder, arguments.output, code)) continue;
    failPart(part.folder, "--output", "is one of the parts", "choose another folder");
  }
  ordered_json merged = parts.begin()->second.document;
  merged["shots"] = ordered_json::array();
  merged["hosts"] = ordered_json::array();
  merged.erase("shard");
  for (const auto& [index, part] : parts) {
    merged["hosts"].push_back(part.document["host"]);
    for (const auto& shot : part.document["shots"]) {
      addShot(merged["shots"], shot, part);
      copyPicture(part, valueAt(shot, "/reference/picture"), arguments.output);
      for (const auto& mask : valueAt(shot, "/maskPictures")) {
        copyPicture(part, mask, arguments.output);
      }
      for (const auto& result : shot["results"]) copyPicture(part, valueAt(result, "/picture"), arguments.output);
    }
  }
  writeBench(merged, arguments.output);
  return 0;
}

}  // namespace lensgraph::cli
