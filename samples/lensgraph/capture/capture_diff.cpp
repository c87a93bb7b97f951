// Matching of passes, weighing of changes: see capture_diff.h.
#include "samples/lensgraph/capture/capture_diff.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

namespace lensgraph::cli {
namespace {

uint64_t distance(const CountChange& change) {
  return change.before > change.after ? change.before - change.after : change.after - change.before;
}

TimeChange timeChange(const MeasuredTime& before, const MeasuredTime& after, bool hasSpread) {
  TimeChange change{.before = before, .after = after};
  if (!before || !after) {
    change.weight = before || after ? TimeChange::Weight::changed : TimeChange::Weight::noise;
  } else if (hasSpread) {
    const bool meet = before->min <= after->max && after->min <= before->max;
    change.weight = meet ? TimeChange::Weight::noise : TimeChange::Weight::changed;
  } else {
    change.weight = before->median == after->median ? TimeChange::Weight::noise : TimeChange::Weight::unknown;
  }
  return change;
}

/// Passes by their unique names.
std::vector<std::pair<std::string, const PassFacts*>> named(const CaptureFacts& facts) {
  std::vector<std::pair<std::string, const PassFacts*>> passes;
  std::map<std::string, int> seen;
  for (const PassFacts& pass : facts.passes) {
    const int number = ++seen[pass.name];
    passes.emplace_back(number == 1 ? pass.name : pass.name + " #" + std::to_string(number), &pass);
  }
  return passes;
}

PassChange passChange(const std::string& name, const PassFacts* before, const PassFacts* after, bool hasSpread) {
  static const PassFacts kNothing;
  const PassFacts& a = before != nullptr ? *before : kNothing;
  const PassFacts& b = after != nullptr ? *after : kNothing;
  return {.name = name,
          .kind = before == nullptr  ? PassChange::Kind::added
                  : after == nullptr ? PassChange::Kind::removed
                                     : PassChange::Kind::same,
          .gpuMs = timeChange(a.gpuMs, b.gpuMs, hasSpread),
          .recordMs = timeChange(a.recordMs, b.recordMs, hasSpread),
          .bytesRead = {a.bytesRead, b.bytesRead},
          .bytesWritten = {a.bytesWritten, b.bytesWritten},
          .imageBarriers = {a.imageBarriers, b.imageBarriers},
          .bufferBarriers = {a.bufferBarriers, b.bufferBarriers},
          .width = {a.width, b.width},
          .height = {a.height, b.height}};
}

/// Largest first: changed or not, device time beyond the noise, bytes, barriers, noise.
auto impactOf(const PassChange& pass) {
  const double ms = std::abs(pass.gpuMs.ms());
  const bool isNoise = pass.gpuMs.weight == TimeChange::Weight::noise;
  return std::tuple(pass.changed(), isNoise ? 0.0 : ms, distance(pass.bytesRead) + distance(pass.bytesWritten),
                    distance(pass.imageBarriers) + distance(pass.bufferBarriers), ms);
}

std::vector<ConditionChange> conditionChanges(const CaptureFacts& before, const CaptureFacts& after) {
  std::set<std::string> names;
  for (const auto& [name, value] : before.conditions) names.insert(name);
  for (const auto& [name, value] : after.conditions) names.insert(name);
  const auto valueIn = [](const CaptureFacts& facts, const std::string& name) {
    const auto found = facts.conditions.find(name);
    return found == facts.conditions.end() ? std::string() : found->second;
  };
  std::vector<ConditionChange> changes;
  for (const std::string& name : names) {
    ConditionChange change{name, valueIn(before, name), valueIn(after, name)};
    if (change.before != change.after) changes.push_back(std::move(change));
  }
  return changes;
}

}  // namespace

double TimeChange::ms() const {
  return (after ? after->median : 0.0) - (before ? before->median : 0.0);
}

bool PassChange::changed() const {
  // The host's recording times are of microseconds and never still; they are told, but are no change.
  return kind != Kind::same || gpuMs.weight != TimeChange::Weight::noise || bytesRead.changed() ||
         bytesWritten.changed() || imageBarriers.changed() || bufferBarriers.changed() || width.changed() ||
         height.changed();
}

CaptureDiff diffCaptures(const CaptureFacts& before, const CaptureFacts& after) {
  const bool hasSpread = before.frames > 1 && after.frames > 1;
  CaptureDiff diff{.conditions = conditionChanges(before, after),
                   .frameGpuMs = timeChange(before.frameGpuMs, after.frameGpuMs, hasSpread),
                   .frameWallMs = timeChange(before.frameWallMs, after.frameWallMs, hasSpread),
                   .peakBytes = {before.peakBytes, after.peakBytes},
                   .unaliasedBytes = {before.unaliasedBytes, after.unaliasedBytes},
                   .lowerBound = {before.lowerBound, after.lowerBound},
                   .barrierBatches = {before.barrierBatches, after.barrierBatches},
                   .passCount = {before.passes.size(), after.passes.size()},
                   .passes = {}};
  std::map<std::string, const PassFacts*> olds;
  for (const auto& [name, pass] : named(before)) olds[name] = pass;
  std::set<std::string> matched;
  for (const auto& [name, pass] : named(after)) {
    const auto old = olds.find(name);
    diff.passes.push_back(passChange(name, old == olds.end() ? nullptr : old->second, pass, hasSpread));
    matched.insert(name);
  }
  for (const auto& [name, pass] : named(before)) {
    if (!matched.contains(name)) diff.passes.push_back(passChange(name, pass, nullptr, hasSpread));
  }
  std::stable_sort(diff.passes.begin(), diff.passes.end(),
                   [](const PassChange& a, const PassChange& b) { return impactOf(a) > impactOf(b); });
  return diff;
}

}  // namespace lensgraph::cli
