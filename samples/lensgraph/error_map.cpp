// The error map: see error_map.h.
#include "samples/lensgraph/error_map.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/image/srgb.h"
#include "engine/metrics/displayed.h"

namespace lensgraph::cli {
namespace {
// Five colours of matplotlib's "inferno" (0, 1/4, …, 1): lightness rises evenly, and so it reads in grey too.
constexpr std::array<std::array<float, 3>, 5> kColors = {{{0.001f, 0.000f, 0.014f},
                                                          {0.342f, 0.062f, 0.429f},
                                                          {0.736f, 0.216f, 0.330f},
                                                          {0.978f, 0.557f, 0.035f},
                                                          {0.988f, 0.998f, 0.645f}}};
}  // namespace

std::array<float, 3> errorColor(float error) {
  constexpr auto last = static_cast<float>(kColors.size() - 1);
  const float at = std::clamp(error / kErrorMapEnd, 0.0f, 1.0f) * last;
  const auto left = static_cast<std::size_t>(std::min(std::floor(at), last - 1.0f));
  const float share = at - static_cast<float>(left);
  std::array<float, 3> color;
  for (std::size_t i = 0; i < 3; ++i) color[i] = std::lerp(kColors[left][i], kColors[left + 1][i], share);
  return color;
}

engine::FloatImage errorMap(const engine::FloatImage& picture, const engine::FloatImage& reference, double exposureEv) {
  engine::FloatImage map(picture.width, picture.height, 3);
  std::vector<float> a(std::size_t{3} * map.width), b(a.size());
  for (uint32_t y = 0; y < map.height; ++y) {
    engine::displayRow(picture, exposureEv, y, a);
    engine::displayRow(reference, exposureEv, y, b);
    for (uint32_t x = 0; x < map.width; ++x) {
      float error = 0.0f;
      for (std::size_t i = 0; i < 3; ++i) error = std::max(error, std::abs(a[3 * x + i] - b[3 * x + i]));
      const auto color = errorColor(error);
      for (std::size_t i = 0; i < 3; ++i) map.pixel(x, y)[i] = engine::linearFromSrgb(color[i]);
    }
  }
  return map;
}

}  // namespace lensgraph::cli
