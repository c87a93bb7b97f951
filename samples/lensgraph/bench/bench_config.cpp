// Configurations from JSON, and the built-in one: see bench_config.h.
#include "samples/lensgraph/bench/bench_config.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "engine/error.h"
#include "samples/host/json_reader.h"
#include "samples/host/measures/shot_files.h"
#include "samples/host/shot.h"
#include "samples/lensgraph/bench/names.h"

namespace lensgraph::cli {
namespace {

using host::JsonNode;
using std::filesystem::path;

constexpr int kMostRepeats = 1000;
constexpr int kMostReferenceSamples = 65536;

/// A configuration that would take longer than anyone waits is a mistake in it.
constexpr std::size_t kMostVariants = 10'000;

path existingFile(const JsonNode& node, const path& folder) {
  const path file = folder / node.text();
  std::error_code code;
  if (!std::filesystem::is_regular_file(file, code)) node.fail("no such file: " + file.string(), "check the path");
  return file;
}

BenchShot parseShot(const JsonNode& node, const path& folder) {
  if (node.isString()) return {existingFile(node, folder), {}};
  node.requireObject({"shot", "reference"});
  BenchShot shot{existingFile(node.at("shot", "name a shot file"), folder), {}};
  if (const auto reference = node.find("reference")) shot.reference = existingFile(*reference, folder);
  return shot;
}

BenchSize parseSize(const JsonNode& node) {
  const auto sides = node.elements(2, "width and height in px");
  return {static_cast<int>(sides[0].integer(1, host::kMaxResolution)),
          static_cast<int>(sides[1].integer(1, host::kMaxResolution))};
}

/// Every combination of the values of the parameters.
std::vector<passes::ParameterSet> combinations(const JsonNode& parameters) {
  parameters.requireObject();
  std::vector<passes::ParameterSet> sets(1);
  for (const auto& [name, node] : parameters.fields()) {
    const auto values = node.json().is_array() ? node.elements() : std::vector<JsonNode>{node};
    if (values.empty()) node.fail("is an empty array", "give at least one value");
    if (sets.size() * values.size() > kMostVariants) {
      node.fail("makes more than " + std::to_string(kMostVariants) + " combinations", "give fewer values");
    }
    std::vector<passes::ParameterSet> extended;
    for (const auto& set : sets) {
      for (const auto& value : values) {
        extended.push_back(set);
        extended.back()[name] = host::parameterValue(value);
      }
    }
    sets = std::move(extended);
  }
  return sets;
}

void parseVariant(const JsonNode& node, std::vector<BenchVariant>& variants) {
  node.requireObject({"technique", "parameters"});
  const auto named = node.at("technique", "name a technique");
  const auto& technique = host::requireTechnique(named, named.text());
  std::vector<passes::ParameterSet> sets(1);
  const auto parameters = node.find("parameters");
  if (parameters) sets = combinations(*parameters);
  for (auto& set : sets) {
    const auto problems = passes::check(set, technique.parameters);
    if (!problems.empty()) {
      parameters->failAt(problems.front().parameter, problems.front().reason, problems.front().remedy);
    }
    host::TechniqueChoice choice{std::string(technique.name), std::move(set)};
    std::string id = variantId(choice);
    variants.push_back({std::move(id), std::move(choice)});
  }
}

std::vector<BenchVariant> everyTechnique() {
  std::vector<BenchVariant> variants;
  for (const auto& technique : passes::techniques()) {
    if (technique.name == "accumulation") continue;
    host::TechniqueChoice choice{std::string(technique.name), {}};
    variants.push_back({variantId(choice), std::move(choice)});
  }
  return variants;
}

/// The same variant twice, or two shots of one id, could not be told apart in the results.
template <class Items, class IdOf>
void requireUnique(const JsonNode& node, const Items& items, const IdOf& idOf) {
  std::set<std::string> seen;
  for (const auto& item : items) {
    if (!seen.insert(idOf(item)).second) node.fail("has " + idOf(item) + " twice", "remove one of them");
  }
}

void parseShots(const JsonNode& root, const path& folder, BenchConfig& config) {
  const auto shots = root.at("shots", "name the shot files to render");
  for (const auto& shot : shots.elements()) config.shots.push_back(parseShot(shot, folder));
  if (config.shots.empty()) shots.fail("is empty", "name at least one shot file");
  requireUnique(shots, config.shots, [](const BenchShot& shot) { return shotId(shot.shot); });
}

void parseLists(const JsonNode& root, BenchConfig& config) {
  if (const auto sizes = root.find("sizes")) {
    for (const auto& size : sizes->elements()) config.sizes.push_back(parseSize(size));
    requireUnique(*sizes, config.sizes,
                  [](const BenchSize& size) { return std::to_string(size.width) + "x" + std::to_string(size.height); });
  }
  const auto variants = root.find("variants");
  if (!variants) {
    config.variants = everyTechnique();
    return;
  }
  for (const auto& variant : variants->elements()) parseVariant(variant, config.variants);
  if (config.variants.empty()) variants->fail("is empty", "name at least one technique");
  requireUnique(*variants, config.variants, [](const BenchVariant& variant) { return variant.id; });
}

std::vector<path> sortedEntries(const path& folder) {
  std::vector<path> entries;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) entries.push_back(entry.path());
  std::sort(entries.begin(), entries.end());
  return entries;
}

void addFolder(const path& folder, std::vector<BenchShot>& shots) {
  const auto addHolder = [&](const path& holder) {
    if (!std::filesystem::is_regular_file(holder / "shot.json")) return false;
    BenchShot shot{holder / "shot.json", {}};
    if (std::filesystem::is_regular_file(holder / "dof.exr")) shot.reference = holder / "dof.exr";
    shots.push_back(std::move(shot));
    return true;
  };
  if (addHolder(folder)) return;
  for (const auto& entry : sortedEntries(folder)) {
    if (entry.extension() == ".json" && std::filesystem::is_regular_file(entry)) shots.push_back({entry, {}});
    if (std::filesystem::is_directory(entry)) addHolder(entry);
  }
}

}  // namespace

BenchConfig readBenchConfig(const path& file, std::vector<BenchShot> shots) {
  const auto document = host::readJsonFile(file);
  const JsonNode root(document, file);
  root.requireObject({"name", "shots", "sizes", "variants", "repeats", "referenceSamples", "exposureEv"});
  BenchConfig config;
  const auto name = root.find("name");
  config.name = name ? name->text() : file.stem().string();
  config.shots = std::move(shots);
  if (config.shots.empty()) parseShots(root, file.parent_path(), config);
  parseLists(root, config);
  if (const auto repeats = root.find("repeats")) config.repeats = static_cast<int>(repeats->integer(1, kMostRepeats));
  if (const auto samples = root.find("referenceSamples")) {
    config.referenceSamples = static_cast<int>(samples->integer(kLeastReferenceSamples, kMostReferenceSamples));
  }
  if (const auto exposure = root.find("exposureEv")) config.exposureEv = exposure->number(-30.0, 30.0);
  return config;
}

BenchConfig quickBench(std::vector<BenchShot> shots) {
  BenchConfig config;
  config.name = "quick";
  config.shots = std::move(shots);
  config.variants = everyTechnique();
  config.repeats = 3;
  return config;
}

std::vector<BenchShot> findShots(const std::vector<path>& paths) {
  std::vector<BenchShot> shots;
  const auto fail = [](const path& where, const std::string& reason) {
    throw engine::Error({.file = where.string(),
                         .field = "--shots",
                         .reason = reason,
                         .remedy = "name a shot file, or a folder that holds some"});
  };
  for (const auto& each : paths) {
    std::error_code code;
    const std::size_t before = shots.size();
    if (std::filesystem::is_directory(each, code)) {
      addFolder(each, shots);
    } else if (std::filesystem::is_regular_file(each, code)) {
      shots.push_back({each, {}});
    } else {
      fail(each, "no such file or folder");
    }
    if (shots.size() == before) fail(each, "holds no shot files");
  }
  std::set<std::string> seen;
  for (const auto& shot : shots) {
    if (!seen.insert(shotId(shot.shot)).second) fail(shot.shot, "a second shot called " + shotId(shot.shot));
  }
  return shots;
}

nlohmann::ordered_json identityOf(const BenchConfig& config) {
  std::string shots, sizes, variants;
  for (const auto& shot : config.shots) {
    auto files = host::filesOf(host::readShot(shot.shot));
    if (shot.reference) files.push_back(*shot.reference);
    shots += (shots.empty() ? "" : ", ") + shotId(shot.shot) + " " + host::hashOfFiles(files);
  }
  for (const auto& size : config.sizes) {
    sizes += (sizes.empty() ? "" : ", ") + std::to_string(size.width) + "x" + std::to_string(size.height);
  }
  for (const auto& variant : config.variants) variants += (variants.empty() ? "" : ", ") + variant.id;
  return {{"shots", shots},
          {"sizes", sizes},
          {"variants", variants},
          {"repeats", config.repeats},
          {"referenceSamples", config.referenceSamples},
          {"exposureEv", config.exposureEv}};
}

}  // namespace lensgraph::cli
