// The two-pass filter of Zhou, Chen, Pullen 2007 on the CPU, in double precision, straight from the paper's
// formulas. Shares no code with the shaders: it exists so that they can be wrong and be caught.
#pragma once

#include <array>
#include <vector>

namespace lensgraph::support {

/// A picture with the depth of each pixel. Row by row, from the top.
struct RgbzPicture {
  int width = 0, height = 0;
  std::vector<std::array<double, 3>> rgb;
  std::vector<double> viewDepth;  ///< m; infinity is the sky.
};

struct TwoPassFilterSettings {
  double pixelsPerTangent = 1.0;  ///< S, px.
  double apertureRadius = 0.0;    ///< E, m.
  double focusDistance = 1.0;     ///< m; infinity allowed.
  double maxRadius = 256.0;       ///< px.
  double minRadius = 0.5;         ///< px.
  double leakage = 0.25;          ///< 1/px.
};

/// Precondition: all values finite (depth may be infinite), depths > 0.
std::vector<std::array<double, 3>> filterTwoPass(const RgbzPicture& picture, const TwoPassFilterSettings& settings);

}  // namespace lensgraph::support
