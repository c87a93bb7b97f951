// The failure masks but for partial occlusion, which partial_occlusion.cpp finds: see failure_masks.h.
#include "engine/metrics/failure_masks.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "engine/error.h"

namespace lensgraph::engine {
namespace {

constexpr double kStep = 1.0;            // px: c of two neighbours that differ by more belong to different surfaces.
constexpr double kNearField = -1.0;      // px: what has a smaller c is blurred visibly in front of the focus.
constexpr float kInFocus = 0.5f;         // px: a disc of this radius fits into its pixel.
constexpr float kBrightestShown = 1.0f;  // Linear light that a display shows at exposure 0.

// Discs of pixels, painted as one run for each row of a disc.
class Discs {
 public:
  Discs(uint32_t width, uint32_t height) : width_(width), height_(height), changes_(size_t{width + 1} * height, 0) {}

  /// All pixels whose distance to (x, y) is at most `radius`.
  void add(int64_t x, int64_t y, double radius) {
    const auto reach = static_cast<int64_t>(std::min<double>(radius, height_));
    for (int64_t row = std::max<int64_t>(y - reach, 0); row <= std::min<int64_t>(y + reach, height_ - 1); ++row) {
      const int64_t half = halfWidth(radius, row - y);
      int32_t* changes = changes_.data() + row * (width_ + 1);
      ++changes[std::max<int64_t>(x - half, 0)];
      --changes[std::min<int64_t>(x + half, width_ - 1) + 1];
    }
  }

  FloatImage painted() const {
    FloatImage mask(static_cast<uint32_t>(width_), static_cast<uint32_t>(height_), 1);
    for (int64_t y = 0; y < height_; ++y) {
      int64_t covering = 0;
      for (int64_t x = 0; x < width_; ++x) {
        covering += changes_[static_cast<size_t>(y * (width_ + 1) + x)];
        mask.samples[static_cast<size_t>(y * width_ + x)] = covering > 0 ? 1.0f : 0.0f;
      }
    }
    return mask;
  }

 private:
  // The largest integer dx with dx² + dy² ≤ radius², at most the width. Precondition: |dy| ≤ radius.
  int64_t halfWidth(double radius, int64_t dy) const {
    const double left = radius * radius - static_cast<double>(dy * dy);
    auto half = static_cast<int64_t>(std::sqrt(std::min(left, static_cast<double>(width_ * width_))));
    while (static_cast<double>(half * half) > left) --half;
    while (half < width_ && static_cast<double>((half + 1) * (half + 1)) <= left) ++half;
    return half;
  }

  int64_t width_, height_;
  std::vector<int32_t> changes_;  ///< By row, width + 1 of each: runs that begin, less runs that have ended.
};

// Whether the pixel is the nearer side of a step to its neighbour.
bool isNearerSide(double c, double neighbour) {
  return c < kNearField && neighbour - c > kStep;
}

}  // namespace

FloatImage nearEdgeMask(const FloatImage& cocRadius) {
  const uint32_t width = cocRadius.width, height = cocRadius.height;
  Discs discs(width, height);
  const auto at = [&](uint32_t x, uint32_t y) { return double{*cocRadius.pixel(x, y)}; };
  for (uint32_t y = 0; y < height; ++y) {
    for (uint32_t x = 0; x < width; ++x) {
      const double c = at(x, y);
      const bool atStep = (x > 0 && isNearerSide(c, at(x - 1, y))) ||
                          (x + 1 < width && isNearerSide(c, at(x + 1, y))) ||
                          (y > 0 && isNearerSide(c, at(x, y - 1))) || (y + 1 < height && isNearerSide(c, at(x, y + 1)));
      if (atStep) discs.add(x, y, std::fabs(c));
    }
  }
  return discs.painted();
}

FloatImage inFocusMask(const FloatImage& cocRadius) {
  FloatImage mask(cocRadius.width, cocRadius.height, 1);
  std::transform(cocRadius.samples.begin(), cocRadius.samples.end(), mask.samples.begin(),
                 [](float c) { return std::fabs(c) < kInFocus ? 1.0f : 0.0f; });
  return mask;
}

FloatImage highlightMask(const FloatImage& reference) {
  FloatImage mask(reference.width, reference.height, 1);
  const uint32_t colors = std::min(reference.channels, 3u);
  for (size_t i = 0; i < mask.samples.size(); ++i) {
    const float* p = reference.samples.data() + i * reference.channels;
    mask.samples[i] = std::any_of(p, p + colors, [](float s) { return s > kBrightestShown; }) ? 1.0f : 0.0f;
  }
  return mask;
}

std::vector<FailureMask> failureMasks(const FloatImage& cocRadius, const FloatImage& reference) {
  if (cocRadius.isEmpty() || cocRadius.channels != 1) throw Error("circles of confusion must be one channel of pixels");
  if (cocRadius.width != reference.width || cocRadius.height != reference.height) {
    throw Error("circles of confusion and the reference differ in size");
  }
  if (!std::all_of(cocRadius.samples.begin(), cocRadius.samples.end(), [](float c) { return std::isfinite(c); })) {
    throw Error("a circle of confusion is not finite");
  }
  std::vector<FailureMask> masks;
  masks.push_back({"nearEdge", nearEdgeMask(cocRadius)});
  masks.push_back({"inFocus", inFocusMask(cocRadius)});
  masks.push_back({"partialOcclusion", partialOcclusionMask(cocRadius)});
  masks.push_back({"highlight", highlightMask(reference)});
  return masks;
}

}  // namespace lensgraph::engine
