// From records of turns to medians and ratios: see bench_document.h.
#include "samples/lensgraph/bench/results/bench_document.h"

#include <cmath>
#include <ctime>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <tuple>
#include <utility>

#include "rendergraph/capture_series.h"
#include "samples/lensgraph/bench/results/equal_quality.h"
#include "samples/lensgraph/bench/results/json_values.h"
#include "samples/lensgraph/bench/units.h"
#include "samples/lensgraph/capture/capture_file.h"

namespace lensgraph::cli {
namespace {

using nlohmann::ordered_json;

/// Times of one variant of one program, by round.
struct Turns {
  std::vector<double> cpuMs, wallMs, gpuMs;
};

/// By case, program and name of the variant or unit.
using TurnTable = std::map<std::tuple<std::string, std::string, std::string>, Turns>;

TurnTable turnsOf(const Journal& journal) {
  TurnTable table;
  for (const auto& record : journal.records()) {
    if (!record.contains("round") || !record.contains("cpuMs")) continue;
    Turns& turns = table[{record["case"], record["program"], record["id"]}];
    turns.cpuMs.push_back(record["cpuMs"]);
    turns.wallMs.push_back(record["wallMs"]);
    turns.gpuMs.push_back(record["gpuMs"]);
  }
  return table;
}

ordered_json timesJson(const Turns& turns) {
  return {
      {"cpuMs", samplesJson(turns.cpuMs)}, {"wallMs", samplesJson(turns.wallMs)}, {"gpuMs", samplesJson(turns.gpuMs)}};
}

/// Quotients of two variants' times, round by round, each divided by `divisor`.
std::vector<double> quotients(const std::vector<double>& above, const std::vector<double>& below,
                              double divisor = 1.0) {
  std::vector<double> all;
  for (std::size_t round = 0; round < above.size() && round < below.size(); ++round) {
    if (above[round] > 0.0 && below[round] > 0.0) all.push_back(above[round] / below[round] / divisor);
  }
  return all;
}

/// Ratios and their ranges of one result.
struct Ratios {
  ordered_json medians = ordered_json::object(), ranges = ordered_json::object();

  void add(ordered_json& toMedians, ordered_json& toRanges, const std::string& name,
           const std::optional<std::vector<double>>& values) {
    if (!values || values->empty()) {
      toMedians[name] = toRanges[name] = nullptr;
      return;
    }
    const auto spread = rendergraph::spreadOf(*values);
    toMedians[name] = spread.median;
    toRanges[name] = {spread.min, spread.max};
  }
  void add(const std::string& name, const std::optional<std::vector<double>>& values) {
    add(medians, ranges, name, values);
  }
};

class Results {
 public:
  Results(const ordered_json& facts, const Journal& journal)
      : journal_(journal),
        turns_(turnsOf(journal)),
        usesCpuTime_(facts["device"].value("type", "") == "cpu"),
        rounds_(facts["settings"]["repeats"].get<std::size_t>()) {}

  /// A case with its units, curve and results.
  ordered_json caseJson(const ordered_json& record) const {
    ordered_json shot = record;
    shot.erase("key");
    shot["case"] = shot["id"];
    shot["id"] = shot["shot"];
    shot.erase("shot");
    const std::string id = record["id"];
    for (const auto& [name, unit] : kUnits) {
      if (const Turns* turns = find(id, "this", unit)) shot["units"][name] = timesJson(*turns);
    }
    shot["results"] = ordered_json::array();
    for (const auto& variant : journal_.records()) {
      if (!variant.contains("technique") || variant["case"] != id || variant.contains("unavailable")) continue;
      const Turns* turns = find(id, variant["program"], variant["id"]);
      if (turns != nullptr) shot["results"].push_back(resultJson(record, variant, *turns));
    }
    return shot;
  }

 private:
  static constexpr std::pair<const char*, const char*> kUnits[] = {
      {"pinhole", kPinholeUnit}, {"copy", kCopyUnit}, {"accumulationView", kViewUnit}};

  const Turns* find(const std::string& id, const std::string& program, const std::string& name) const {
    const auto found = turns_.find({id, program, name});
    return found == turns_.end() || found->second.cpuMs.size() < rounds_ ? nullptr : &found->second;
  }

  /// The time that ratios are of.
  const std::vector<double>& basis(const Turns& turns) const { return usesCpuTime_ ? turns.cpuMs : turns.gpuMs; }

  std::optional<std::vector<double>> over(const Turns& turns, const Turns* other, double divisor = 1.0) const {
    if (other == nullptr) return {};
    return quotients(basis(turns), basis(*other), divisor);
  }

  /// This variant's time over that of accumulation with as many views as have its quality.
  std::optional<std::vector<double>> overAccumulation(const ordered_json& shot, const Turns& turns, const char* figure,
                                                      const ordered_json& quality) const {
    if (!quality.contains(figure) || !quality[figure].is_number()) return {};
    const bool isSsim = std::string_view(figure) == "ssim";
    std::vector<CurvePoint> curve;
    for (const auto& point : shot["accumulation"]) {
      if (!point[figure].is_number()) continue;
      const double value = point[figure];
      curve.push_back({point["samples"], isSsim ? ssimDecibels(value) : value});
    }
    const double value = quality[figure];
    const auto samples = samplesAtQuality(curve, isSsim ? ssimDecibels(value) : value);
    if (!samples) return {};
    return over(turns, find(shot["id"], "this", kViewUnit), *samples);
  }

  /// Medians of the units that took turns with the case's results. Of a merged benchmark those of the result's own part.
  ordered_json unitMedians(const std::string& id) const {
    ordered_json medians = ordered_json::object();
    for (const auto& [name, unit] : kUnits) {
      const Turns* turns = find(id, "this", unit);
      medians[name] = turns == nullptr ? ordered_json() : ordered_json(rendergraph::spreadOf(basis(*turns)).median);
    }
    return medians;
  }

  ordered_json resultJson(const ordered_json& shot, const ordered_json& variant, const Turns& turns) const {
    const std::string id = shot["id"];
    ordered_json result = variant;
    for (const char* internal : {"key", "case"}) result.erase(internal);
    result.update(timesJson(turns));
    result["unitMs"] = unitMedians(id);
    Ratios ratios;
    ratios.add("pinhole", over(turns, find(id, "this", kPinholeUnit)));
    ratios.add("copy", over(turns, find(id, "this", kCopyUnit)));
    ratios.medians["programs"] = ratios.ranges["programs"] = ordered_json::object();
    for (const auto& other : journal_.records()) {
      const bool isSame = other.contains("technique") && other["case"] == id && other["id"] == variant["id"] &&
                          other["program"] != variant["program"];
      if (!isSame) continue;
      ratios.add(ratios.medians["programs"], ratios.ranges["programs"], other["program"],
                 over(turns, find(id, other["program"], other["id"])));
    }
    ratios.add("accumulationAtPsnr", overAccumulation(shot, turns, "psnr", variant["quality"]));
    ratios.add("accumulationAtSsim", overAccumulation(shot, turns, "ssim", variant["quality"]));
    result["ratios"] = std::move(ratios.medians);
    result["ratioRanges"] = std::move(ratios.ranges);
    return result;
  }

  const Journal& journal_;
  TurnTable turns_;
  bool usesCpuTime_;
  std::size_t rounds_;
};

std::string now() {
  const std::time_t seconds = std::time(nullptr);
  std::tm utc{};
  ::gmtime_r(&seconds, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text;
}

/// A value in a table with commas: texts in quotes, nothing for null.
std::string cell(const ordered_json& value) {
  if (value.is_null()) return "";
  if (!value.is_string()) return value.dump();
  std::string text = value;
  for (std::size_t at = 0; (at = text.find('"', at)) != std::string::npos; at += 2) text.insert(at, 1, '"');
  return "\"" + text + "\"";
}

}  // namespace

ordered_json benchDocument(const ordered_json& facts, const Journal& journal) {
  ordered_json document = {{"format", kBenchFormat}, {"formatVersion", kBenchVersion}};
  document.update(facts);
  document["date"] = now();
  document["shots"] = ordered_json::array();
  const Results results(facts, journal);
  for (const auto& record : journal.records()) {
    if (record.contains("sceneHash")) document["shots"].push_back(results.caseJson(record));
  }
  return document;
}

std::string benchTable(const ordered_json& document) {
  static constexpr const char* kShotColumns[] = {"id", "width", "height", "triangles"};
  static constexpr const char* kColumns[] = {"program",
                                             "id",
                                             "technique",
                                             "cpuMs/median",
                                             "cpuMs/min",
                                             "cpuMs/max",
                                             "wallMs/median",
                                             "gpuMs/median",
                                             "memory/graphBytes",
                                             "quality/psnr",
                                             "quality/ssim",
                                             "quality/flip",
                                             "quality/relativeRmse",
                                             "quality/maxError",
                                             "ratios/pinhole",
                                             "ratios/copy",
                                             "ratios/accumulationAtPsnr",
                                             "ratios/accumulationAtSsim"};
  std::string text = "shot,width,height,triangles";
  for (const std::string column : kColumns) text += "," + column;
  for (const auto& shot : document["shots"]) {
    for (const auto& result : shot["results"]) {
      std::string line;
      for (const char* column : kShotColumns) line += (line.empty() ? "" : ",") + cell(shot[column]);
      for (const std::string column : kColumns) line += "," + cell(valueAt(result, "/" + column));
      text += "\n" + line;
    }
  }
  return text + "\n";
}

}  // namespace lensgraph::cli
