// FLIP's colour spaces: see flip_color.h.
#include "engine/metrics/flip_color.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace lensgraph::engine {
namespace {

using Matrix = std::array<std::array<double, 3>, 3>;

// XYZ of linear sRGB from its primaries and D65, in fractions, as FLIP's authors use it.
constexpr Matrix kXyzFromLinear = {{{10135552.0 / 24577794.0, 8788810.0 / 24577794.0, 4435075.0 / 24577794.0},
                                    {2613072.0 / 12288897.0, 8788810.0 / 12288897.0, 887015.0 / 12288897.0},
                                    {1425312.0 / 73733382.0, 8788810.0 / 73733382.0, 70074185.0 / 73733382.0}}};

// Each row divided by its sum: white (1,1,1) becomes (1,1,1).
constexpr Matrix relativeToWhite(Matrix m) {
  for (auto& row : m) {
    const double sum = row[0] + row[1] + row[2];
    for (double& value : row) value /= sum;
  }
  return m;
}

constexpr Matrix inverse(const Matrix& m) {
  Matrix result{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t a = (j + 1) % 3, b = (j + 2) % 3, c = (i + 1) % 3, d = (i + 2) % 3;
      result[i][j] = m[a][c] * m[b][d] - m[a][d] * m[b][c];
    }
  }
  const double determinant = m[0][0] * result[0][0] + m[0][1] * result[1][0] + m[0][2] * result[2][0];
  for (auto& row : result) {
    for (double& value : row) value /= determinant;
  }
  return result;
}

constexpr Matrix kRelative = relativeToWhite(kXyzFromLinear);
constexpr Matrix kLinear = inverse(kRelative);

constexpr float rowTimes(const std::array<double, 3>& row, float a, float b, float c) {
  return static_cast<float>(row[0]) * a + static_cast<float>(row[1]) * b + static_cast<float>(row[2]) * c;
}

// CIE 1976: the cube root, continued by its tangent below (6/29)³.
float lightness(float t) {
  constexpr float delta = 6.0f / 29.0f;
  return t > delta * delta * delta ? std::cbrt(t) : t / (3.0f * delta * delta) + 4.0f / 29.0f;
}

}  // namespace

RelativeXyz relativeXyz(float r, float g, float b) {
  return {rowTimes(kRelative[0], r, g, b), rowTimes(kRelative[1], r, g, b), rowTimes(kRelative[2], r, g, b)};
}

Opponent opponentOf(const RelativeXyz& xyz) {
  return {xyz.y, xyz.x - xyz.y, xyz.y - xyz.z};
}

HuntLab huntLab(const Opponent& color) {
  const float x = color.luminance + color.redGreen, y = color.luminance, z = color.luminance - color.blueYellow;
  const auto channel = [&](std::size_t i) { return std::clamp(rowTimes(kLinear[i], x, y, z), 0.0f, 1.0f); };
  const RelativeXyz shown = relativeXyz(channel(0), channel(1), channel(2));
  const float fx = lightness(shown.x), fy = lightness(shown.y), fz = lightness(shown.z);
  const float l = 116.0f * fy - 16.0f;
  return {l, 0.01f * l * 500.0f * (fx - fy), 0.01f * l * 200.0f * (fy - fz)};
}

float hyab(const HuntLab& a, const HuntLab& b) {
  const float da = a.a - b.a, db = a.b - b.b;
  return std::fabs(a.l - b.l) + std::sqrt(da * da + db * db);
}

}  // namespace lensgraph::engine
