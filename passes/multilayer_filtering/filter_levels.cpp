#include "passes/multilayer_filtering/filter_levels.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace passes::multilayer_filtering {
namespace {

using shared::FilterLevel;

constexpr int kTopLevel = static_cast<int>(shared::kMaxFilterLevels) - 1;
constexpr double kPixelVariance = 1.0 / 12.0;  // px²: of the box over a pixel that a picture is expected to have

/// Indices from first to last, both included.
struct Span {
  int first = 0, last = 0;
};

Span unite(Span a, Span b) {
  return {std::min(a.first, b.first), std::max(a.last, b.last)};
}

/// The part of `a` inside `b`; where there is none, b's index nearest to it.
Span clip(Span a, Span b) {
  return {std::clamp(a.first, b.first, b.last), std::clamp(a.last, b.first, b.last)};
}

int half(int index) {
  return index >= 0 ? index / 2 : -((1 - index) / 2);
}

/// How one level is made from the one before.
struct Step {
  int tapDistance = 0;  ///< 0: mip step.
  Span tapsOf(Span cells) const {
    if (tapDistance == 0) return {2 * cells.first, 2 * cells.last + 1};
    return {cells.first, cells.last + tapDistance};
  }
  /// Cells that differ from one another when the level before has these and repeats beyond.
  Span cellsOf(Span taps) const {
    if (tapDistance == 0) return {half(taps.first), half(taps.last)};
    return {taps.first - tapDistance, taps.last};
  }
};

/// Variance along an axis of level's filter, its look-up included, px².
double filterVariance(const LevelRequest& request, int mipSteps, int level) {
  if (level == 0) return 0.0;
  const double box = (std::exp2(2.0 * level) - 1.0) / 12.0;  // of 2^level points, 1 px apart
  if (!request.bilinear) return box;
  // Mean of f (1 - f) over the places of pixels' centres between cells' centres.
  const double cell = std::exp2(2.0 * std::min(level, mipSteps));
  return box + cell * (1.0 / 6.0 + 1.0 / (12.0 * cell));
}

/// Levels and steps that the blur asks for, or the request.
struct Steps {
  int mip = 0, stack = 0;
  int top() const { return mip + stack; }
};

Steps stepsOf(const LevelRequest& request) {
  Steps steps{.mip = std::clamp(request.mipSteps, 0, kTopLevel), .stack = 0};
  if (request.stackSteps >= 0) {
    steps.stack = std::min(request.stackSteps, kTopLevel - steps.mip);
    return steps;
  }
  const double largest = std::max(request.nearCoc, request.farCoc);
  int top = 0;
  while (top < kTopLevel && shownRadius(request, steps.mip, top) < largest) ++top;
  steps.mip = std::min(steps.mip, top);
  steps.stack = top - steps.mip;
  if (steps.stack > kMostStackSteps) steps = {.mip = top - kMostStackSteps, .stack = kMostStackSteps};
  return steps;
}

Step stepTo(const Steps& steps, int level) {
  return {level <= steps.mip ? 0 : 1 << (level - 1 - steps.mip)};
}

/// The windows of all levels along one axis. A level has the cells that the picture looks up there and those that coarser
/// levels are made of, as far as they differ from their neighbours.
std::vector<Span> windows(const LevelRequest& request, const Steps& steps, int pixels) {
  const int top = steps.top();
  std::vector<Span> spans(static_cast<std::size_t>(top) + 1);
  for (int level = top; level >= 0; --level) {
    const double cellSize = std::exp2(std::min(level, steps.mip));
    const double centre = 0.5 * std::exp2(level);
    const double rounding = request.bilinear ? 0.0 : 0.5;
    const auto first = static_cast<int>(std::floor((0.5 - centre) / cellSize + rounding));
    const auto last = static_cast<int>(std::floor((pixels - 0.5 - centre) / cellSize + rounding));
    Span& span = spans[static_cast<std::size_t>(level)];
    span = {first, level > 0 && request.bilinear ? last + 1 : last};
    if (level < top) {
      span = unite(span, stepTo(steps, level + 1).tapsOf(spans[static_cast<std::size_t>(level) + 1]));
    }
  }
  const auto border = static_cast<int>(std::ceil(request.border));
  Span distinct{-border, pixels - 1 + border};
  spans[0] = clip(spans[0], distinct);
  for (int level = 1; level <= top; ++level) {
    distinct = stepTo(steps, level).cellsOf(level == 1 ? spans[0] : distinct);
    spans[static_cast<std::size_t>(level)] = clip(spans[static_cast<std::size_t>(level)], distinct);
  }
  return spans;
}

/// Coarsest level that shows blurs up to a radius.
uint32_t coarsestFor(const std::vector<FilterLevel>& levels, double radius) {
  uint32_t level = 0;
  while (level + 1 < levels.size() && std::sqrt(levels[level].own) < radius) ++level;
  return level;
}

}  // namespace

double shownRadius(const LevelRequest& request, int mipSteps, int level) {
  if (request.match == LevelMatch::diameter) return 0.5 * std::exp2(level);
  const double variance = filterVariance(request, mipSteps, level) - kPixelVariance;
  return std::sqrt(std::max(variance, 0.0) / request.apertureMoment);
}

LevelPlan planLevels(const LevelRequest& request) {
  const Steps steps = stepsOf(request);
  const auto columns = windows(request, steps, static_cast<int>(request.extent.width));
  const auto rows = windows(request, steps, static_cast<int>(request.extent.height));
  const auto squared = [&](int level) { return std::pow(shownRadius(request, steps.mip, level), 2.0); };
  LevelPlan plan;
  for (int i = 0; i <= steps.top(); ++i) {
    const auto& [x, y] = std::pair(columns[static_cast<std::size_t>(i)], rows[static_cast<std::size_t>(i)]);
    FilterLevel level{};
    level.first = {x.first, y.first};
    level.size = {x.last - x.first + 1, y.last - y.first + 1};
    level.cellSize = static_cast<float>(std::exp2(std::min(i, steps.mip)));
    level.centre = static_cast<float>(0.5 * std::exp2(i));
    level.firstList = plan.listCount;
    level.tapDistance = i > 0 ? stepTo(steps, i).tapDistance : 0;
    level.inner = static_cast<float>(i > 0 ? squared(i - 1) : 0.0);
    level.own = static_cast<float>(squared(i));
    level.outer = i < steps.top() ? static_cast<float>(squared(i + 1)) : std::numeric_limits<float>::max();
    level.keepNear = level.keepFar = 1;
    plan.listCount += static_cast<uint32_t>(level.size.x) * static_cast<uint32_t>(level.size.y) + 1;
    plan.levels.push_back(level);
  }
  plan.nearLevels = coarsestFor(plan.levels, request.nearCoc);
  plan.farLevels = coarsestFor(plan.levels, request.farCoc);
  if (!request.truncate) return plan;
  for (std::size_t i = 1; i < plan.levels.size(); ++i) {
    FilterLevel& level = plan.levels[i];
    level.dropWithin = std::sqrt(level.inner);
    level.keepNear = i <= plan.nearLevels ? 1 : 0;
    level.keepFar = i <= plan.farLevels ? 1 : 0;
  }
  return plan;
}

}  // namespace passes::multilayer_filtering
