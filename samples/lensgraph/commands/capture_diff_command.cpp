// lensgraph capture-diff: what changed between two captures, as text and as JSON.
#include <algorithm>
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>

#include "samples/lensgraph/capture/capture_diff.h"
#include "samples/lensgraph/capture/capture_file.h"
#include "samples/lensgraph/subcommands.h"

namespace lensgraph::cli {
namespace {

using nlohmann::json;
using Weight = TimeChange::Weight;

template <class... Values>
std::string format(const char* pattern, Values... values) {
  const int size = std::snprintf(nullptr, 0, pattern, values...);
  std::string text(static_cast<std::size_t>(std::max(size, 0)), '\0');
  std::snprintf(text.data(), text.size() + 1, pattern, values...);
  return text;
}

const char* nameOf(Weight weight) {
  switch (weight) {
    case Weight::changed:
      return "changed";
    case Weight::noise:
      return "noise";
    case Weight::unknown:
      return "unknown";
  }
  return "?";
}

const char* nameOf(PassChange::Kind kind) {
  switch (kind) {
    case PassChange::Kind::same:
      return "same";
    case PassChange::Kind::added:
      return "added";
    case PassChange::Kind::removed:
      return "removed";
  }
  return "?";
}

std::string timeText(const MeasuredTime& time) {
  return time ? format("%.3f", time->median) : "–";
}

/// "12.1 -> 13.2 ms, +1.1 (+9.1 %), noise".
std::string changeText(const TimeChange& change) {
  if (!change.before && !change.after) return "not measured";
  std::string text = timeText(change.before) + " -> " + timeText(change.after) + " ms";
  text += format(", %+.3f", change.ms());
  if (change.before && change.before->median > 0.0 && change.after) {
    text += format(" (%+.1f %%)", 100.0 * change.ms() / change.before->median);
  }
  if (change.weight == Weight::noise) text += ", noise";
  if (change.weight == Weight::unknown) text += ", spread unknown: one frame";
  return text;
}

std::string changeText(const CountChange& change) {
  const auto before = static_cast<double>(change.before), after = static_cast<double>(change.after);
  std::string text = std::to_string(change.before) + " -> " + std::to_string(change.after);
  if (change.changed() && change.before > 0) text += format(" (%+.1f %%)", 100.0 * (after - before) / before);
  return text;
}

void addCount(std::string& text, const char* what, const CountChange& change) {
  if (change.changed()) text += format("    %-16s %s\n", what, changeText(change).c_str());
}

std::string passText(const PassChange& pass) {
  std::string text = pass.kind == PassChange::Kind::same ? "  " : pass.kind == PassChange::Kind::added ? "+ " : "- ";
  text += pass.name + "\n";
  if (pass.gpuMs.weight != Weight::noise || pass.gpuMs.ms() != 0.0) {
    text += format("    %-16s %s\n", "device time", changeText(pass.gpuMs).c_str());
  }
  addCount(text, "bytes read", pass.bytesRead);
  addCount(text, "bytes written", pass.bytesWritten);
  addCount(text, "image barriers", pass.imageBarriers);
  addCount(text, "buffer barriers", pass.bufferBarriers);
  addCount(text, "width", pass.width);
  addCount(text, "height", pass.height);
  return text;
}

json toJson(const MeasuredTime& time) {
  return time ? cli::toJson(*time) : json();
}

json toJson(const TimeChange& change) {
  return {{"before", toJson(change.before)},
          {"after", toJson(change.after)},
          {"differenceMs", change.ms()},
          {"weight", nameOf(change.weight)}};
}

json toJson(const CountChange& change) {
  return {{"before", change.before}, {"after", change.after}};
}

json toJson(const PassChange& pass) {
  return {{"name", pass.name},
          {"kind", nameOf(pass.kind)},
          {"changed", pass.changed()},
          {"gpuMs", toJson(pass.gpuMs)},
          {"recordMs", toJson(pass.recordMs)},
          {"bytesRead", toJson(pass.bytesRead)},
          {"bytesWritten", toJson(pass.bytesWritten)},
          {"imageBarriers", toJson(pass.imageBarriers)},
          {"bufferBarriers", toJson(pass.bufferBarriers)},
          {"width", toJson(pass.width)},
          {"height", toJson(pass.height)}};
}

}  // namespace

std::string diffText(const CaptureDiff& diff, const std::string& before, const std::string& after) {
  std::string text = before + " -> " + after + "\n";
  if (!diff.conditions.empty()) text += "\nmade under different conditions\n";
  for (const auto& condition : diff.conditions) {
    text +=
        format("  %-16s %s -> %s\n", condition.what.c_str(), condition.before.empty() ? "–" : condition.before.c_str(),
               condition.after.empty() ? "–" : condition.after.c_str());
  }
  text += "\nframe\n";
  text += format("  %-16s %s\n", "device time", changeText(diff.frameGpuMs).c_str());
  text += format("  %-16s %s\n", "wall time", changeText(diff.frameWallMs).c_str());
  const std::pair<const char*, const CountChange*> counts[] = {{"passes", &diff.passCount},
                                                               {"barrier batches", &diff.barrierBatches},
                                                               {"memory, bytes", &diff.peakBytes},
                                                               {"  not aliased", &diff.unaliasedBytes},
                                                               {"  lower bound", &diff.lowerBound}};
  for (const auto& [what, change] : counts) text += format("  %-16s %s\n", what, changeText(*change).c_str());
  const auto changed = std::ranges::count_if(diff.passes, &PassChange::changed);
  text += format("\npasses that changed: %d of %d\n", static_cast<int>(changed), static_cast<int>(diff.passes.size()));
  bool inNoise = false;
  for (const PassChange& pass : diff.passes) {
    const bool silent = !pass.changed() && pass.gpuMs.ms() == 0.0;
    if (silent) continue;
    if (!pass.changed() && !inNoise) text += "\nwithin the measured spread\n";
    inNoise = !pass.changed();
    text += passText(pass);
  }
  return text;
}

json diffJson(const CaptureDiff& diff) {
  json conditions = json::array(), passes = json::array();
  for (const auto& condition : diff.conditions) {
    conditions.push_back({{"what", condition.what}, {"before", condition.before}, {"after", condition.after}});
  }
  for (const auto& pass : diff.passes) passes.push_back(toJson(pass));
  return {{"conditions", std::move(conditions)},
          {"frameGpuMs", toJson(diff.frameGpuMs)},
          {"frameWallMs", toJson(diff.frameWallMs)},
          {"passCount", toJson(diff.passCount)},
          {"barrierBatches", toJson(diff.barrierBatches)},
          {"memory",
           {{"peakBytes", toJson(diff.peakBytes)},
            {"unaliasedBytes", toJson(diff.unaliasedBytes)},
            {"lowerBound", toJson(diff.lowerBound)}}},
          {"passes", std::move(passes)}};
}

int runCaptureDiff(const CaptureDiffArguments& arguments) {
  const CaptureFacts before = readCapture(arguments.before), after = readCapture(arguments.after);
  const CaptureDiff diff = diffCaptures(before, after);
  std::cout << (arguments.json ? diffJson(diff).dump(2) + "\n" : diffText(diff, before.file, after.file));
  return 0;
}

}  // namespace lensgraph::cli
