// From the range of |c| in a picture to the levels that show it: which |c| each level shows, how far its cells must reach
// for the window of the next level, and where they lie in the buffer of cells.
#include "passes/multilayer_filtering/filter_levels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <utility>

namespace lensgraph::passes::multilayer_filtering {
namespace {

using shared::FilterLevel;
using shared::FilterLook;

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
  /// px, side of the filter's box.
  double width(int level) const { return std::exp2(level - subpixel); }
  /// px, of the centre of cell 0: half the filter's width, for cells are named after their first tap.
  double centre(int level) const { return 0.5 * width(level); }
};

/// Variance along an axis of a level's box, px²: of points, one in each of the lists' pixels.
double boxVariance(const Steps& steps, int level) {
  return (std::pow(steps.width(level), 2.0) - std::exp2(-2.0 * steps.subpixel)) / 12.0;
}

/// |c| of the circle of confusion whose blur of a pixel has this variance.
double radiusOf(const LevelRequest& request, double variance) {
  return std::sqrt(std::max(variance - kPixelVariance, 0.0) / request.apertureMoment);
}

/// Radii of the round blurs that are made of a box, as a share of its width: half an octave apart, and such that eight boxes
/// leave neither a hole in the middle (larger) nor a peak (smaller).
constexpr std::array<double, 2> kRoundRadii = {0.873, 1.235};

/// Whether taps, which fall on whole cells, can be placed well enough around a pixel.
bool canBeRound(const LevelRequest& request, const Steps& steps, int level) {
  return request.kernel == Kernel::round && request.match == LevelMatch::moments && request.bilinear &&
         steps.width(level) >= 4.0 * steps.cellSize(level);
}

/// Looks' squared radii grow at least so much from one to the next.
constexpr double kWidening = 1.2;

/// Distance in cells of eight taps that make of a level's box a blur of this radius.
double ringFor(const LevelRequest& request, const Steps& steps, int level, double radius) {
  const double cell = steps.cellSize(level);
  const double wanted = request.apertureMoment * radius * radius + kPixelVariance;
  const double ofTaps = wanted - boxVariance(steps, level) - cell * cell / 12.0;  // less the taps' rounding to cells
  return std::sqrt(std::max(2.0 * ofTaps, 0.0)) / cell;
}

/// Variance along an axis of a ring of boxes as it is: taps fall on whole cells (openRing() in look.glsl).
double ringVariance(const Steps& steps, int level, double ring) {
  const double cell = steps.cellSize(level), diagonal = ring * std::numbers::sqrt2 / 2.0;
  const int phases = static_cast<int>(cell);
  double sum = 0.0;
  for (int i = 0; i < phases; ++i) {
    const double place = (i + 0.5) / phases;  // of a pixel among the cells
    const auto up = [&](double offset) { return std::pow(std::floor(place + 0.5 + offset) - place, 2.0); };
    const auto down = [&](double offset) { return std::pow(std::ceil(place - 0.5 - offset) - place, 2.0); };
    sum += (up(ring) + down(ring) + up(0.0) + down(0.0)) / 8.0 + (up(diagonal) + down(diagonal)) / 4.0;
  }
  return boxVariance(steps, level) + cell * cell * sum / phases;
}

/// What a level is looked up for: at the pixel, by its box, and around it.
void addLooks(const LevelRequest& request, const Steps& steps, int level, std::vector<FilterLook>& looks) {
  const auto add = [&](double radius, double ring) {
    // Taps fall on whole cells, so that a ring may turn out no wider than the one before.
    if (!looks.empty() && radius * radius < kWidening * looks.back().own) return;
    FilterLook look{};
    look.level = static_cast<uint32_t>(level);
    look.ring = static_cast<float>(ring);
    look.own = static_cast<float>(radius * radius);
    look.halfWidth = static_cast<float>(steps.centre(level) + ring * steps.cellSize(level));
    looks.push_back(look);
  };
  if (request.match == LevelMatch::diameter) {
    add(0.5 * steps.width(level), 0.0);
    return;
  }
  // Boxes lead to the first that can be round.
  if (!canBeRound(request, steps, level) || !canBeRound(request, steps, level - 1)) {
    double variance = boxVariance(steps, level);
    if (request.bilinear && level > steps.subpixel) {
      // Mean of f (1 - f) over the places of pixels' centres between cells' centres.
      const double cell = steps.cellSize(level) * steps.cellSize(level);
      variance += cell * (1.0 / 6.0 + 1.0 / (12.0 * cell));
    }
    add(radiusOf(request, variance), 0.0);
  }
  if (!canBeRound(request, steps, level)) return;
  // The moment of a disc is that of the share; other apertures' blurs are as wide as a disc's of equal moment.
  const double scale = std::sqrt(0.25 / request.apertureMoment);
  for (const double share : kRoundRadii) {
    const double radius = share * scale * steps.width(level);
    const double ring = ringFor(request, steps, level, radius);
    add(radiusOf(request, ringVariance(steps, level, ring)), ring);
  }
}

/// All looks of levels up to the steps' last.
std::vector<FilterLook> looksOf(const LevelRequest& request, const Steps& steps) {
  std::vector<FilterLook> looks;
  for (int level = steps.subpixel; level <= steps.top(); ++level) addLooks(request, steps, level, looks);
  return looks;
}

/// As many as the blur asks for, or as the request says.
Steps stepsOf(const LevelRequest& request) {
  const int most = kTopLevel - request.subpixelSteps;
  Steps steps{.subpixel = request.subpixelSteps, .mip = std::clamp(request.mipSteps, 0, most), .stack = 0};
  if (request.stackSteps >= 0) {
    steps.stack = std::min(request.stackSteps, most - steps.mip);
    return steps;
  }
  const int mip = steps.mip;
  const double largest = std::max(request.nearCoc, request.farCoc);
  for (int needed = 0; needed <= most; ++needed) {
    steps.mip = std::max(std::min(mip, needed), needed - kMostStackSteps);
    steps.stack = needed - steps.mip;
    if (std::sqrt(looksOf(request, steps).back().own) >= largest) break;
  }
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

/// Cells of a level that a look reads along one axis.
Span lookedUp(const LevelRequest& request, const Steps& steps, const FilterLook& look, int pixels) {
  const auto level = static_cast<int>(look.level);
  const bool isInterpolated = request.bilinear && level > steps.subpixel && look.ring == 0.0f;
  const auto cellAt = [&](double place) {
    return static_cast<int>(
        std::floor((place - steps.centre(level)) / steps.cellSize(level) + (isInterpolated ? 0.0 : 0.5)));
  };
  const auto ring = static_cast<int>(std::ceil(look.ring));
  return {cellAt(0.5) - ring, cellAt(pixels - 0.5) + ring + (isInterpolated ? 1 : 0)};
}

/// The windows of all levels along one axis. A level has the cells that the picture looks up there and those that coarser
/// levels are made of, as far as they differ from their neighbours.
std::vector<Span> windows(const LevelRequest& request, const Steps& steps, std::span<const FilterLook> looks,
                          int pixels) {
  const auto top = static_cast<int>(looks.back().level);
  std::vector<Span> spans(static_cast<std::size_t>(top) + 1);
  for (int level = top; level >= 0; --level) {
    Span& span = spans[static_cast<std::size_t>(level)];
    bool isEmpty = level == top;
    if (!isEmpty) span = tapsOf(spans[static_cast<std::size_t>(level) + 1], steps.tapDistance(level + 1));
    for (const FilterLook& look : looks) {
      if (static_cast<int>(look.level) != level) continue;
      const Span own = lookedUp(request, steps, look, pixels);
      span = std::exchange(isEmpty, false) ? own : unite(span, own);
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

/// Widest look that shows blurs up to a radius.
uint32_t widestFor(std::span<const FilterLook> looks, double radius) {
  uint32_t look = 0;
  while (look + 1 < looks.size() && std::sqrt(looks[look].own) < radius) ++look;
  return look;
}

/// Sets where looks begin and cease to show: where their neighbours show alone.
void joinLooks(std::vector<FilterLook>& looks) {
  for (std::size_t i = 0; i < looks.size(); ++i) {
    looks[i].inner = i > 0 ? looks[i - 1].own : 0.0f;
    looks[i].outer = i + 1 < looks.size() ? looks[i + 1].own : std::numeric_limits<float>::max();
  }
}

/// What levels beyond the picture's resolution may drop.
void truncate(LevelPlan& plan) {
  const auto finest = plan.looks.front().level;
  for (auto look = plan.looks.rbegin(); look != plan.looks.rend(); ++look) {  // The narrowest of a level comes last.
    if (look->level == finest) continue;
    FilterLevel& level = plan.levels[look->level];
    level.dropWithin = static_cast<float>(1.0 - kDropMargin) * std::sqrt(look->inner);
    // What lies in focus but for rounding belongs to both sides.
    const float inFocus = std::max(level.dropWithin, 0.5f);
    const auto number = static_cast<std::size_t>(plan.looks.rend() - look) - 1;
    level.lowest = number > plan.nearLooks ? -inFocus : -std::numeric_limits<float>::max();
    level.highest = number > plan.farLooks ? inFocus : std::numeric_limits<float>::max();
  }
}

}  // namespace

LevelPlan planLevels(const LevelRequest& request) {
  const Steps steps = stepsOf(request);
  LevelPlan plan;
  plan.looks = looksOf(request, steps);
  // Levels that the configuration has and the blur does not need are left out.
  const double largest = std::max(request.nearCoc, request.farCoc);
  plan.looks.resize(std::min<std::size_t>(widestFor(plan.looks, largest) + 1, shared::kMaxLooks));
  joinLooks(plan.looks);
  const auto columns = windows(request, steps, plan.looks, static_cast<int>(request.extent.width));
  const auto rows = windows(request, steps, plan.looks, static_cast<int>(request.extent.height));
  for (int i = 0; i <= static_cast<int>(plan.looks.back().level); ++i) {
    const Span x = columns[static_cast<std::size_t>(i)], y = rows[static_cast<std::size_t>(i)];
    FilterLevel level{};
    level.first = {x.first, y.first};
    level.size = {x.last - x.first + 1, y.last - y.first + 1};
    level.cellSize = static_cast<float>(steps.cellSize(i));
    level.centre = static_cast<float>(steps.centre(i));
    level.firstList = plan.listCount;
    level.tapDistance = steps.tapDistance(i);
    level.lowest = -std::numeric_limits<float>::max();
    level.highest = std::numeric_limits<float>::max();
    plan.listCount += static_cast<uint32_t>(level.size.x) * static_cast<uint32_t>(level.size.y) + 1;
    plan.levels.push_back(level);
  }
  plan.nearLooks = widestFor(plan.looks, request.nearCoc);
  plan.farLooks = widestFor(plan.looks, request.farCoc);
  if (request.truncate) truncate(plan);
  return plan;
}

}  // namespace lensgraph::passes::multilayer_filtering
