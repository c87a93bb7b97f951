// The sRGB curve: see srgb.h. Both directions compute in double, so that 1 maps to 1 exactly and a sum over a picture
// shows no rounding of the curve.
#include "engine/image/srgb.h"

#include <cmath>

namespace lensgraph::engine {

float srgbFromLinear(float linear) {
  const double x = linear;
  return static_cast<float>(x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055);
}

float linearFromSrgb(float encoded) {
  const double x = encoded;
  return static_cast<float>(x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4));
}

}  // namespace lensgraph::engine
