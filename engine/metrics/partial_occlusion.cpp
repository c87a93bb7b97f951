// The mask of partial occlusion (failure_masks.h): pixels p for which some pixel q has |c_q - c_p| > 1 and
// |p - q| ≤ max(|c_p|, |c_q|).
//
// Trying every pair would cost the square of the blur for every pixel. Instead squares of pixels are compared, with the
// least and the largest c in each: most pairs of squares either cannot hold such a pair of pixels, or hold one for each
// of their pixels. The rest is split into quarters. All tests are exact: distances are integers, c is compared in double.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "engine/metrics/bands.h"
#include "engine/metrics/failure_masks.h"

namespace lensgraph::engine {
namespace {

constexpr double kApart = 1.0;  // px: surfaces whose c differ by more count as different.

constexpr uint32_t kTopLevel = 6;  // Squares of 2^6 = 64 px, about the reach of a wide blur, are compared first.
constexpr uint32_t kPixelLevel =
    3;  // Squares of 8 px are no longer split on the side of p: its pixels are tried singly.

// The c of a square of pixels, and the pixels: x from x0 to x1, y from y0 to y1, both ends included.
struct Square {
  double least = 0.0, largest = 0.0;
  int64_t x0 = 0, y0 = 0, x1 = 0, y1 = 0;

  double largestReach() const { return std::max(std::fabs(least), std::fabs(largest)); }
  double leastReach() const { return std::max({0.0, least, -largest}); }
};

struct Place {
  uint32_t x = 0, y = 0;  ///< In squares of the level.
};

// Least and largest c of all aligned squares of 1, 2, 4 … 2^kTopLevel pixels.
class Pyramid {
 public:
  explicit Pyramid(const FloatImage& cocRadius) : width_(cocRadius.width), height_(cocRadius.height) {
    levels_.push_back({width_, height_, cocRadius.samples, cocRadius.samples});
    while (levels_.size() <= kTopLevel) levels_.push_back(halved(levels_.back()));
  }

  uint32_t columns(uint32_t level) const { return levels_[level].width; }
  uint32_t rows(uint32_t level) const { return levels_[level].height; }

  Square square(uint32_t level, Place at) const {
    const Level& values = levels_[level];
    const size_t index = size_t{at.y} * values.width + at.x;
    const int64_t size = int64_t{1} << level;
    const int64_t x0 = at.x * size, y0 = at.y * size;
    return {values.least[index],
            values.largest[index],
            x0,
            y0,
            std::min<int64_t>(x0 + size, width_) - 1,
            std::min<int64_t>(y0 + size, height_) - 1};
  }

  /// Calls visit(place) for the quarters, one level down, of a square.
  template <class Visit>
  void forEachQuarter(uint32_t level, Place at, const Visit& visit) const {
    for (uint32_t y = 2 * at.y; y < std::min(2 * at.y + 2, rows(level - 1)); ++y) {
      for (uint32_t x = 2 * at.x; x < std::min(2 * at.x + 2, columns(level - 1)); ++x) visit(Place{x, y});
    }
  }

 private:
  struct Level {
    uint32_t width, height;
    std::vector<float> least, largest;
  };

  static Level halved(const Level& from) {
    Level to{(from.width + 1) / 2, (from.height + 1) / 2, {}, {}};
    for (uint32_t y = 0; y < to.height; ++y) {
      for (uint32_t x = 0; x < to.width; ++x) {
        const size_t first = size_t{2 * y} * from.width + 2 * x;
        const size_t right = 2 * x + 1 < from.width ? 1 : 0, down = 2 * y + 1 < from.height ? from.width : 0;
        const size_t all[] = {first, first + right, first + down, first + right + down};
        float least = from.least[first], largest = from.largest[first];
        for (const size_t i : all) {
          least = std::min(least, from.least[i]);
          largest = std::max(largest, from.largest[i]);
        }
        to.least.push_back(least);
        to.largest.push_back(largest);
      }
    }
    return to;
  }

  uint32_t width_, height_;
  std::vector<Level> levels_;
};

// Squared distances between the nearest and between the farthest pixels of two squares.
double nearestSquared(const Square& p, const Square& q) {
  const int64_t dx = std::max<int64_t>({0, q.x0 - p.x1, p.x0 - q.x1}),
                dy = std::max<int64_t>({0, q.y0 - p.y1, p.y0 - q.y1});
  return static_cast<double>(dx * dx + dy * dy);
}
double farthestSquared(const Square& p, const Square& q) {
  const int64_t dx = std::max(q.x1 - p.x0, p.x1 - q.x0), dy = std::max(q.y1 - p.y0, p.y1 - q.y0);
  return static_cast<double>(dx * dx + dy * dy);
}

enum class Answer { none, all, perhaps };

// Whether the pixels of square p have a partner in q: none has one, all have one, or it takes a closer look.
Answer partners(const Square& p, const Square& q) {
  if (std::max(q.largest - p.least, p.largest - q.least) <= kApart) return Answer::none;
  const double reach = std::max(p.largestReach(), q.largestReach());
  if (nearestSquared(p, q) > reach * reach) return Answer::none;
  const double farthest = farthestSquared(p, q);
  // Every pixel of p has a partner somewhere in q, and reaches all of q.
  const bool someIsApart =
      q.largest - p.largest > kApart || p.least - q.least > kApart || q.largest - q.least > 2.0 * kApart;
  if (someIsApart && farthest <= p.leastReach() * p.leastReach()) return Answer::all;
  // Every pixel of q is a partner of every one of p, and reaches all of p.
  const bool allAreApart = q.least - p.largest > kApart || p.least - q.largest > kApart;
  if (allAreApart && farthest <= q.leastReach() * q.leastReach()) return Answer::all;
  return Answer::perhaps;
}

class Search {
 public:
  Search(const Pyramid& pyramid, FloatImage& mask) : pyramid_(pyramid), mask_(mask) {}

  /// Decides all pixels of a square. `candidates`: the squares of the same level that may hold partners.
  void decide(uint32_t level, Place at, const std::vector<Place>& candidates) {
    const Square p = pyramid_.square(level, at);
    std::vector<Place> open;
    for (const Place candidate : candidates) {
      const Answer answer = partners(p, pyramid_.square(level, candidate));
      if (answer == Answer::all) return paint(p);
      if (answer == Answer::perhaps) open.push_back(candidate);
    }
    if (open.empty()) return;
    if (level == kPixelLevel) return decidePixels(p, open);
    std::vector<Place> quarters;
    for (const Place candidate : open) {
      pyramid_.forEachQuarter(level, candidate, [&](Place quarter) { quarters.push_back(quarter); });
    }
    pyramid_.forEachQuarter(level, at, [&](Place quarter) { decide(level - 1, quarter, quarters); });
  }

 private:
  void paint(const Square& p) {
    for (int64_t y = p.y0; y <= p.y1; ++y) {
      float* row = mask_.pixel(static_cast<uint32_t>(p.x0), static_cast<uint32_t>(y));
      std::fill(row, row + (p.x1 - p.x0 + 1), 1.0f);
    }
  }

  void decidePixels(const Square& p, const std::vector<Place>& candidates) {
    for (int64_t y = p.y0; y <= p.y1; ++y) {
      for (int64_t x = p.x0; x <= p.x1; ++x) {
        const Square pixel = pyramid_.square(0, {static_cast<uint32_t>(x), static_cast<uint32_t>(y)});
        const bool hasPartner = std::any_of(candidates.begin(), candidates.end(), [&](Place candidate) {
          return hasPartnerIn(pixel, kPixelLevel, candidate);
        });
        if (hasPartner) paint(pixel);
      }
    }
  }

  bool hasPartnerIn(const Square& pixel, uint32_t level, Place at) const {
    const Answer answer = partners(pixel, pyramid_.square(level, at));
    if (answer != Answer::perhaps) return answer == Answer::all;
    // Of two pixels the answer is known: their nearest and farthest distance are one, and so are their c.
    bool found = false;
    pyramid_.forEachQuarter(level, at,
                            [&](Place quarter) { found = found || hasPartnerIn(pixel, level - 1, quarter); });
    return found;
  }

  const Pyramid& pyramid_;
  FloatImage& mask_;
};

}  // namespace

FloatImage partialOcclusionMask(const FloatImage& cocRadius) {
  FloatImage mask(cocRadius.width, cocRadius.height, 1);
  const Pyramid pyramid(cocRadius);
  std::vector<Place> squares;
  for (uint32_t y = 0; y < pyramid.rows(kTopLevel); ++y) {
    for (uint32_t x = 0; x < pyramid.columns(kTopLevel); ++x) squares.push_back({x, y});
  }
  forEachInParallel(squares.size(), [&](size_t i) { Search(pyramid, mask).decide(kTopLevel, squares[i], squares); });
  return mask;
}

}  // namespace lensgraph::engine
