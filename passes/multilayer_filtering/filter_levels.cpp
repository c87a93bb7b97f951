#include "passes/multilayer_filtering/filter_levels.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace passes::multilayer_filtering {
namespace {

constexpr int kTopLevel = static_cast<int>(shared::kMaxFilterLevels) - 1;
/// Of |c|: a level keeps this much beyond what it shows, so that a slanted surface that it begins to show is whole. Enough
/// for slopes of 0.2 px of |c| per px.
constexpr double kDropMargin = 0.5;
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

/// Variance along an axis of the filter of 2^step px, its look-up included, px².
double filterVariance(const LevelRequest& request, int mipSteps, int step) {
  const double pixel = std::exp2(-2.0 * request.subpixelSteps);  // area of the lists' pixels, px²
  const double box = (std::exp2(2.0 * step) - pixel) / 12.0;     // of points, one in each of them
  if (!request.bilinear || step == 0) return box;
  // Mean of f (1 - f) over the places of pixels' centres between cells' centres.
  const double cell = std::exp2(2.0 * std::min(step, mipSteps));
  return box + cell * (1.0 / 6.0 + 1.0 / (12.0 * cell));
}

/// The filter steps: those within the picture's pixels, those that halve its resolution, those that keep it.
struct Steps {
  int subpixel = 0, mip = 0, stack = 0;
  int top() const { return subpixel + mip + stack; }
  /// Taps of the step to `level`: 0 for a mip step, which takes two times two neighbours, else their distance in cells.
  int tapDistance(int level) const {
    const int stacked = level - subpixel - mip;
    return stacked <= 0 ? 0 : 1 << (stacked - 1);
  }
  /// px from cell to cell.
  double cellSize(int level) const { return std::exp2(std::min(level, subpixel + mip) - subpixel); }
  /// px, of the centre of cell 0: half the filter's width, for cells are named after their first tap.
  double centre(int level) const { return 0.5 * std::exp2(level - subpixel); }
};

/// As many as the blur asks for, or as the request says.
Steps stepsOf(const LevelRequest& request) {
  Steps steps{.subpixel = request.subpixelSteps, .mip = request.mipSteps, .stack = 0};
  const int most = kTopLevel - steps.subpixel;
  steps.mip = std::clamp(steps.mip, 0, most);
  if (request.stackSteps >= 0) {
    steps.stack = std::min(request.stackSteps, most - steps.mip);
    return steps;
  }
  const double largest = std::max(request.nearCoc, request.farCoc);
  int needed = 0;
  while (needed < most && shownRadius(request, steps.mip, needed) < largest) ++needed;
  steps.mip = std::max(std::min(steps.mip, needed), needed - kMostStackSteps);
  steps.stack = needed - steps.mip;
  return steps;
}

/// Cells that the step to a level reads for these.
Span tapsOf(Span cells, int tapDistance) {
  if (tapDistance == 0) return {2 * cells.first, 2 * cells.last + 1};
  return {cells.first, cells.last + tapDistance};
}

/// Cells that differ from one another when the level before has these and repeats beyond.
Span distinctCells(Span taps, int tapDistance) {
  if (tapDistance == 0) return {half(taps.first), half(taps.last)};
  return {taps.first - tapDistance, taps.last};
}

/// Cells of a level that the picture looks up along one axis.
Span lookedUp(const LevelRequest& request, const Steps& steps, int level, int pixels) {
  const double rounding = request.bilinear ? 0.0 : 0.5;
  const auto cellAt = [&](double place) {
    return static_cast<int>(std::floor((place - steps.centre(level)) / steps.cellSize(level) + rounding));
  };
  const bool isInterpolated = request.bilinear && level > steps.subpixel;
  return {cellAt(0.5), cellAt(pixels - 0.5) + (isInterpolated ? 1 : 0)};
}

/// The windows of all levels along one axis. A level has the cells that the picture looks up there and those that coarser
/// levels are made of, as far as they differ from their neighbours.
std::vector<Span> windows(const LevelRequest& request, const Steps& steps, int pixels) {
  const int top = steps.top();
  std::vector<Span> spans(static_cast<std::size_t>(top) + 1);
  for (int level = top; level >= 0; --level) {
    Span& span = spans[static_cast<std::size_t>(level)];
    const Span own = lookedUp(request, steps, level, pixels);
    const bool isShown = level >= steps.subpixel;
    if (level == top) {
      span = own;
    } else {
      span = tapsOf(spans[static_cast<std::size_t>(level) + 1], steps.tapDistance(level + 1));
      if (isShown) span = unite(span, own);
    }
  }
  const int border = static_cast<int>(std::ceil(request.border)) << steps.subpixel;
  Span distinct{-border, (pixels << steps.subpixel) - 1 + border};
  for (int level = 0; level <= top; ++level) {
    if (level > 0) distinct = distinctCells(distinct, steps.tapDistance(level));
    spans[static_cast<std::size_t>(level)] = clip(spans[static_cast<std::size_t>(level)], distinct);
    if (level == 0) distinct = spans[0];
  }
  return spans;
}

/// Coarsest level that shows blurs up to a radius.
uint32_t coarsestFor(const LevelPlan& plan, double radius) {
  uint32_t level = plan.finestShown;
  while (level + 1 < plan.levels.size() && std::sqrt(plan.levels[level].own) < radius) ++level;
  return level;
}

}  // namespace

double shownRadius(const LevelRequest& request, int mipSteps, int step) {
  if (request.match == LevelMatch::diameter) return 0.5 * std::exp2(step);
  const double variance = filterVariance(request, mipSteps, step) - kPixelVariance;
  return std::sqrt(std::max(variance, 0.0) / request.apertureMoment);
}

LevelPlan planLevels(const LevelRequest& request) {
  const Steps steps = stepsOf(request);
  const auto columns = windows(request, steps, static_cast<int>(request.extent.width));
  const auto rows = windows(request, steps, static_cast<int>(request.extent.height));
  const auto squared = [&](int level) {
    return static_cast<float>(std::pow(shownRadius(request, steps.mip, level - steps.subpixel), 2.0));
  };
  LevelPlan plan;
  plan.finestShown = static_cast<uint32_t>(steps.subpixel);
  for (int i = 0; i <= steps.top(); ++i) {
    const Span x = columns[static_cast<std::size_t>(i)], y = rows[static_cast<std::size_t>(i)];
    shared::FilterLevel level{};
    level.first = {x.first, y.first};
    level.size = {x.last - x.first + 1, y.last - y.first + 1};
    level.cellSize = static_cast<float>(steps.cellSize(i));
    level.centre = static_cast<float>(steps.centre(i));
    level.firstList = plan.listCount;
    level.tapDistance = steps.tapDistance(i);
    if (i >= steps.subpixel) {
      level.inner = i > steps.subpixel ? squared(i - 1) : 0.0f;
      level.own = squared(i);
      level.outer = i < steps.top() ? squared(i + 1) : std::numeric_limits<float>::max();
    }
    level.lowest = -std::numeric_limits<float>::max();
    level.highest = std::numeric_limits<float>::max();
    plan.listCount += static_cast<uint32_t>(level.size.x) * static_cast<uint32_t>(level.size.y) + 1;
    plan.levels.push_back(level);
  }
  plan.nearLevels = coarsestFor(plan, request.nearCoc);
  plan.farLevels = coarsestFor(plan, request.farCoc);
  if (!request.truncate) return plan;
  for (std::size_t i = plan.finestShown + 1; i < plan.levels.size(); ++i) {
    shared::FilterLevel& level = plan.levels[i];
    level.dropWithin = static_cast<float>(1.0 - kDropMargin) * std::sqrt(level.inner);
    // What lies in focus but for rounding belongs to both sides.
    const float inFocus = std::max(level.dropWithin, 0.5f);
    if (i > plan.nearLevels) level.lowest = -inFocus;
    if (i > plan.farLevels) level.highest = inFocus;
  }
  return plan;
}

}  // namespace passes::multilayer_filtering
