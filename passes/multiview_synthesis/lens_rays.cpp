// Sets of rays: samples of the aperture, each given to the nearest view.
#include "passes/multiview_synthesis/lens_rays.h"

#include <algorithm>
#include <cmath>

namespace lensgraph::passes::multiview_synthesis {
namespace {

float distance(shared::vec2 a, shared::vec2 b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

/// The lens's centre through the pixel's centre, or points spread over both.
std::vector<LensView> viewPoints(const LensRayRequest& request) {
  if (request.viewCount == 1) return {LensView{}};
  std::vector<LensView> views;
  for (uint32_t i = 0; i < request.viewCount; ++i) {
    const LensSample sample = lensSample(request.aperture, request.pattern, i, true);
    views.push_back({.lens = sample.v, .pixelOffset = sample.pixelOffset, .rays = {}});
  }
  return views;
}

LensView& nearest(std::vector<LensView>& views, shared::vec2 v) {
  return *std::ranges::min_element(views, {}, [&](const LensView& view) { return distance(view.lens, v); });
}

}  // namespace

// The square that a point of the set has to itself, for points of equal density over a disc.
float noiseReach(uint32_t rayCount) {
  return 0.5f * std::sqrt(3.1415927f / static_cast<float>(rayCount));
}

std::vector<LensView> lensViews(const LensRayRequest& request) {
  auto views = viewPoints(request);
  const bool twice = request.jitter == Jitter::halton;
  const auto pattern = twice ? LensPattern::halton : request.pattern;
  // Jitter spreads the lens: shrinking the set keeps its second moment, r²/4 + h²/3 = 1/4 (disc radius r, square ±h).
  const float h = request.jitter == Jitter::noise ? noiseReach(request.rayCount) : 0.0f;
  const float shrink = request.aperture.gaussian != 0u ? 1.0f : std::sqrt(std::max(1.0f - 4.0f * h * h / 3.0f, 0.0f));
  for (const LensSample& sample : lensSamples(request.aperture, pattern, request.rayCount * (twice ? 2 : 1), false)) {
    const shared::vec2 v = {sample.v.x * shrink, sample.v.y * shrink};
    LensView& view = nearest(views, v);
    view.rays.push_back({.lens = v, .weight = sample.weight, .padding = 0.0f});
    view.reach = std::max(view.reach, distance(view.lens, v) + std::sqrt(2.0f) * h);
  }
  std::erase_if(views, [](const LensView& view) { return view.rays.empty(); });
  for (LensView& view : views) {
    const auto count = static_cast<uint32_t>(view.rays.size());
    view.raysPerPixel = twice ? std::max(count / 2, 1u) : count;
  }
  return views;
}

}  // namespace lensgraph::passes::multiview_synthesis
