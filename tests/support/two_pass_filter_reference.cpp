// Zhou 2007 §4.2, written for reading and not for speed: every pixel looks at its whole column, then its
// whole row.
#include "tests/support/two_pass_filter_reference.h"

#include <algorithm>
#include <cmath>

namespace lensgraph::support {
namespace {

using Rgb = std::array<double, 3>;

struct Blur {
  std::vector<double> radius;     ///< px, of every pixel's circle of confusion.
  std::vector<bool> behindFocus;  ///< z_p > z_f.
};

/// Eq. 2 for a lens whose fixed sensor is at its focus, halved (the paper's CoC is a diameter) and in pixels:
/// E·S·|1/u - 1/z|, u the focus distance.
Blur blurOf(const RgbzPicture& picture, const TwoPassFilterSettings& settings) {
  Blur blur;
  for (const double z : picture.viewDepth) {
    const double defocus = 1.0 / settings.focusDistance - 1.0 / z;
    const double radius = settings.apertureRadius * settings.pixelsPerTangent * std::abs(defocus);
    blur.radius.push_back(std::min(radius, settings.maxRadius));
    blur.behindFocus.push_back(z > settings.focusDistance);
  }
  return blur;
}

double overlap(double radius, double distance) {  // O: 0 up to d_p, 1 from the next pixel on.
  if (radius <= distance) return 0.0;
  return radius >= distance + 1.0 ? 1.0 : radius - distance;
}

std::vector<Rgb> filterAlong(const std::vector<Rgb>& input, int width, int height, int stepX, int stepY,
                             const Blur& blur, const TwoPassFilterSettings& settings) {
  const auto intensity = [&](double radius) { return std::pow(std::max(radius, settings.minRadius), -2.0); };
  std::vector<Rgb> output(input.size());
  const int reach = static_cast<int>(std::ceil(settings.maxRadius));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto centre = static_cast<std::size_t>(y * width + x);
      Rgb sum{};
      double weights = 0.0;
      for (int i = -reach; i <= reach; ++i) {
        const int column = std::clamp(x + i * stepX, 0, width - 1), row = std::clamp(y + i * stepY, 0, height - 1);
        const auto p = static_cast<std::size_t>(row * width + column);
        double weight = intensity(blur.radius[p]);
        if (i != 0) {
          weight *= overlap(blur.radius[p], std::abs(i));
          if (blur.behindFocus[p]) weight *= std::min(1.0, settings.leakage * blur.radius[centre]);
        }
        for (std::size_t c = 0; c < 3; ++c) sum[c] += weight * input[p][c];
        weights += weight;
      }
      for (std::size_t c = 0; c < 3; ++c) output[centre][c] = sum[c] / weights;
    }
  }
  return output;
}

}  // namespace

std::vector<Rgb> filterTwoPass(const RgbzPicture& picture, const TwoPassFilterSettings& settings) {
  const Blur blur = blurOf(picture, settings);
  const auto columns = filterAlong(picture.rgb, picture.width, picture.height, 0, 1, blur, settings);
  return filterAlong(columns, picture.width, picture.height, 1, 0, blur, settings);
}

}  // namespace lensgraph::support
