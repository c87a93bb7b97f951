// Conversion of depth and cleaning of colour: see picture_inputs.h.
#include "samples/host/picture_inputs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "samples/host/rendering.h"

namespace lensgraph::host {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Length of the ray through a pixel's centre, by its part along the axis.
double rayLength(const engine::FloatImage& depth, uint32_t x, uint32_t y, double pixelsPerTangent) {
  const double right = (x + 0.5 - 0.5 * depth.width) / pixelsPerTangent;
  const double down = (y + 0.5 - 0.5 * depth.height) / pixelsPerTangent;
  return std::sqrt(1.0 + right * right + down * down);
}

/// Between the two ends, by how far a number is from black to white.
double between(double value, const DepthMeaning& meaning, double atNearest, double atFarthest) {
  const double share = value / meaning.white;
  return std::lerp(atFarthest, atNearest, meaning.isWhiteNear ? share : 1.0 - share);
}

double zOf(double value, const DepthMeaning& meaning, double rayLengthHere) {
  // What stands for "nothing hit" does so in any unit.
  const bool isDistance = meaning.kind == DepthKind::z || meaning.kind == DepthKind::ray;
  if (isDistance && value >= static_cast<double>(kNothingHit)) return std::numeric_limits<double>::infinity();
  switch (meaning.kind) {
    case DepthKind::z:
      return value * meaning.scale;
    case DepthKind::ray:
      return value * meaning.scale / rayLengthHere;
    case DepthKind::normalized:
      return between(value, meaning, meaning.nearest, meaning.farthest);
    case DepthKind::disparity:
      return 1.0 / between(value, meaning, 1.0 / meaning.nearest, 1.0 / meaning.farthest);
  }
  return value;
}

}  // namespace

DepthFindings convertDepth(engine::FloatImage& depth, const DepthMeaning& meaning, double fovyDeg) {
  const double pixelsPerTangent = 0.5 * depth.height / std::tan(fovyDeg * std::numbers::pi / 360.0);
  DepthFindings findings;
  for (uint32_t y = 0; y < depth.height; ++y) {
    for (uint32_t x = 0; x < depth.width; ++x) {
      float& sample = *depth.pixel(x, y);
      const double length = meaning.kind == DepthKind::ray ? rayLength(depth, x, y, pixelsPerTangent) : 1.0;
      const auto z = static_cast<float>(zOf(static_cast<double>(sample), meaning, length));
      if (!(z > 0.0f)) ++findings.holes;
      sample = z > 0.0f ? z : kInfinity;
      if (sample >= kNothingHit) continue;
      findings.nearest = std::min(findings.nearest.value_or(sample), sample);
      findings.farthest = std::max(findings.farthest.value_or(sample), sample);
    }
  }
  return findings;
}

ColorFindings cleanColor(engine::FloatImage& color) {
  engine::FloatImage rgba(color.width, color.height, 4, 1.0f);
  ColorFindings findings;
  for (std::size_t i = 0; i < color.pixelCount(); ++i) {
    const std::span<const float> source = std::span(color.samples).subspan(i * color.channels, color.channels);
    const std::span<float> target = std::span(rgba.samples).subspan(i * 4, 4);
    for (uint32_t c = 0; c < 3; ++c) target[c] = source[color.channels >= 3 ? c : 0];
    if (color.channels == 4) target[3] = source[3];
    if (!std::ranges::all_of(target, [](float value) { return std::isfinite(value); })) {
      std::ranges::copy(std::array{0.0f, 0.0f, 0.0f, 1.0f}, target.begin());
      ++findings.notFinite;
    }
    if (!std::ranges::all_of(target, [](float value) { return std::abs(value) <= kLargestColor; })) {
      for (float& value : target) value = std::clamp(value, -kLargestColor, kLargestColor);
      ++findings.limited;
    }
  }
  color = std::move(rgba);
  return findings;
}

bool hasAlpha(const engine::FloatImage& rgba) {
  for (std::size_t i = 3; i < rgba.samples.size(); i += 4) {
    if (rgba.samples[i] != 1.0f) return true;
  }
  return false;
}

}  // namespace lensgraph::host
