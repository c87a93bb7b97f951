// Ratios of times and changes of quality: see bench_comparison.h.
#include "samples/lensgraph/bench/results/bench_comparison.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "engine/error.h"
#include "samples/lensgraph/bench/results/json_values.h"

namespace lensgraph::cli {
namespace {

using nlohmann::ordered_json;

/// Rounding of the figures as text: smaller changes are none.
constexpr double kSameQuality = 1e-9;

class Comparer {
 public:
  Comparer(const ordered_json& before, const ordered_json& after, const BenchTolerances& tolerances,
           const std::string& beforeName, const std::string& afterName)
      : before_(before), after_(after), tolerances_(tolerances), beforeName_(beforeName), afterName_(afterName) {}

  BenchComparison compare() {
    for (const char* field : {"/device/name", "/device/driver", "/settings/exposureEv", "/settings/referenceSamples"}) {
      requireSame(before_, after_, field, "");
    }
    if (tolerances_.unit == "none") {
      requireSame({{"host", {{"processor", processorsOf(before_)}}}}, {{"host", {{"processor", processorsOf(after_)}}}},
                  "/host/processor", "", "give --unit, so that times are compared as multiples of a unit");
    }
    for (const auto& shot : before_["shots"]) {
      const auto* other = shotLike(after_, shot);
      if (other == nullptr) {
        for (const auto& result : shot["results"]) addOnly(comparison_.onlyBefore, shot, result);
        continue;
      }
      for (const char* field : {"/width", "/height", "/sceneHash", "/reference/kind"}) {
        requireSame(shot, *other, field, shot["id"].get<std::string>() + ".");
      }
      compareShot(shot, *other);
    }
    for (const auto& shot : after_["shots"]) {
      if (shotLike(before_, shot) != nullptr) continue;
      for (const auto& result : shot["results"]) addOnly(comparison_.onlyAfter, shot, result);
    }
    if (comparison_.results.empty()) {
      throw engine::Error({.file = afterName_,
                           .field = "shots",
                           .reason = "has no result that " + beforeName_ + " has too",
                           .remedy = "compare benchmarks of like things"});
    }
    return std::move(comparison_);
  }

 private:
  void requireSame(const ordered_json& first, const ordered_json& second, const std::string& pointer,
                   const std::string& place, const std::string& remedy = "compare benchmarks of like things") const {
    const auto one = valueAt(first, pointer), two = valueAt(second, pointer);
    if (one == two) return;
    std::string field = pointer.substr(1);
    std::replace(field.begin(), field.end(), '/', '.');
    throw engine::Error({.file = afterName_,
                         .field = place + field,
                         .reason = "is " + two.dump() + ", that of " + beforeName_ + " is " + one.dump(),
                         .remedy = remedy});
  }

  /// The processors of all parts, each once.
  static ordered_json processorsOf(const ordered_json& document) {
    std::set<std::string> names;
    if (!document.contains("hosts")) names.insert(valueAt(document, "/host/processor").dump());
    for (const auto& host : valueAt(document, "/hosts")) names.insert(valueAt(host, "/processor").dump());
    return names;
  }

  static bool hasCase(const ordered_json& document, const ordered_json& shot) {
    for (const auto& other : document["shots"]) {
      if (other["case"] == shot["case"]) return true;
    }
    return false;
  }

  /// The shot of that name in that size; else one of that name in another size that has no partner of its own, which is
  /// then refused.
  const ordered_json* shotLike(const ordered_json& document, const ordered_json& shot) const {
    const ordered_json* found = nullptr;
    const ordered_json& ofShot = &document == &after_ ? before_ : after_;
    for (const auto& other : document["shots"]) {
      if (other["case"] == shot["case"]) return &other;
      if (other["id"] == shot["id"] && !hasCase(ofShot, other)) found = &other;
    }
    return found;
  }

  static bool isOwn(const ordered_json& result) { return result["program"] == "this"; }

  static const ordered_json* resultLike(const ordered_json& shot, const ordered_json& result) {
    for (const auto& other : shot["results"]) {
      if (isOwn(other) && other["id"] == result["id"]) return &other;
    }
    return nullptr;
  }

  static void addOnly(std::vector<std::string>& names, const ordered_json& shot, const ordered_json& result) {
    if (isOwn(result)) names.push_back(shot["case"].get<std::string>() + " " + result["id"].get<std::string>());
  }

  void compareShot(const ordered_json& before, const ordered_json& after) {
    for (const auto& result : before["results"]) {
      if (!isOwn(result)) continue;
      const auto* other = resultLike(after, result);
      if (other == nullptr) {
        addOnly(comparison_.onlyBefore, before, result);
      } else {
        comparison_.results.push_back(compareResult(before, result, after, *other));
      }
    }
    for (const auto& result : after["results"]) {
      if (isOwn(result) && resultLike(before, result) == nullptr) addOnly(comparison_.onlyAfter, after, result);
    }
  }

  ComparedResult compareResult(const ordered_json& shotBefore, const ordered_json& before,
                               const ordered_json& shotAfter, const ordered_json& after) const {
    ComparedResult result{
        .shot = shotBefore["case"], .variant = before["id"], .time = {}, .psnrChange = {}, .ssimChange = {}};
    result.time = timeRatio(shotBefore, before, shotAfter, after);
    const bool lostItsTime = timeOf(shotBefore, before) && !timeOf(shotAfter, after);
    result.isSlower = lostItsTime || (result.time && result.time->median > tolerances_.timeRatio);
    result.psnrChange = change(before, after, "/quality/psnr");
    result.ssimChange = change(before, after, "/quality/ssim");
    result.isWorse = fell(before, after, "/quality/psnr", tolerances_.psnr) ||
                     fell(before, after, "/quality/ssim", tolerances_.ssim);
    return result;
  }

  /// Median, min, max of a time in ms, or in multiples of the unit's median.
  std::optional<TimeRatio> timeOf(const ordered_json& shot, const ordered_json& result) const {
    const std::string clock = valueAt(before_, "/device/type") == "cpu" ? "/cpuMs" : "/gpuMs";
    const auto time = valueAt(result, clock);
    if (!time.is_object()) return {};
    double unit = 1.0;
    if (tolerances_.unit != "none") {
      const auto own = valueAt(result, "/unitMs/" + tolerances_.unit);
      const auto median = own.is_number() ? own : valueAt(shot, "/units/" + tolerances_.unit + clock + "/median");
      if (!median.is_number() || median.get<double>() <= 0.0) return {};
      unit = median;
    }
    return TimeRatio{time["median"].get<double>() / unit, time["min"].get<double>() / unit,
                     time["max"].get<double>() / unit};
  }

  std::optional<TimeRatio> timeRatio(const ordered_json& shotBefore, const ordered_json& before,
                                     const ordered_json& shotAfter, const ordered_json& after) const {
    const auto one = timeOf(shotBefore, before), two = timeOf(shotAfter, after);
    if (!one || !two || one->lowest <= 0.0) return {};
    return TimeRatio{two->median / one->median, two->lowest / one->highest, two->highest / one->lowest};
  }

  static std::optional<double> change(const ordered_json& before, const ordered_json& after, const char* pointer) {
    const auto one = valueAt(before, pointer), two = valueAt(after, pointer);
    if (!one.is_number() || !two.is_number()) return {};
    return two.get<double>() - one.get<double>();
  }

  /// Whether a quality fell; one that was infinite (equal pictures) and is no more has fallen too.
  static bool fell(const ordered_json& before, const ordered_json& after, const char* pointer, double tolerance) {
    const auto one = valueAt(before, pointer), two = valueAt(after, pointer);
    if (one == "infinity") return two != "infinity";
    if (!one.is_number()) return false;
    if (two == "infinity") return false;
    return !two.is_number() || two.get<double>() < one.get<double>() - tolerance - kSameQuality;
  }

  const ordered_json &before_, &after_;
  const BenchTolerances& tolerances_;
  const std::string &beforeName_, &afterName_;
  BenchComparison comparison_;
};

}  // namespace

bool BenchComparison::hasRegression() const {
  if (mustBeComplete && !onlyBefore.empty()) return true;
  return std::any_of(results.begin(), results.end(), [](const auto& each) { return each.isSlower || each.isWorse; });
}

BenchComparison compareBenches(const ordered_json& before, const ordered_json& after, const BenchTolerances& tolerances,
                               const std::string& beforeName, const std::string& afterName) {
  auto comparison = Comparer(before, after, tolerances, beforeName, afterName).compare();
  comparison.mustBeComplete = tolerances.mustBeComplete;
  return comparison;
}

}  // namespace lensgraph::cli
