// Sums and moments of the light around one point of a picture.
#include "tests/support/gpu/spot.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/gpu/test_scenes.h"

namespace lensgraph::support {

Spot measureSpot(const engine::FloatImage& picture) {
  const auto each = [&](auto&& visit) {
    for (uint32_t row = 0; row < picture.height; ++row) {
      for (uint32_t column = 0; column < picture.width; ++column) {
        visit(column + 0.5, row + 0.5, static_cast<double>(picture.pixel(column, row)[0]));
      }
    }
  };
  Spot spot;
  each([&](double x, double y, double value) {
    spot.flux += value;
    spot.x += x * value;
    spot.y += y * value;
  });
  spot.x /= spot.flux;
  spot.y /= spot.flux;
  each([&](double x, double y, double value) {
    const double dx = x - spot.x, dy = y - spot.y;
    spot.varianceX += dx * dx * value / spot.flux;
    spot.varianceY += dy * dy * value / spot.flux;
    spot.covariance += dx * dy * value / spot.flux;
    if (value > 0.0) spot.extent = std::max(spot.extent, std::hypot(dx, dy));
  });
  // A uniform disc of radius R has mean squared distance R²/2 from its centre.
  spot.radius = std::sqrt(2.0 * (spot.varianceX + spot.varianceY));
  return spot;
}

engine::Scene lightScene(double depth, double sidePx, double pixelsPerTangent, double x, double y) {
  engine::Scene scene;
  const double metresPerPx = depth / pixelsPerTangent;
  const uint32_t material = addMaterial(scene, glm::vec4(100.0f, 100.0f, 100.0f, 1.0f));
  addFacingQuad(scene, depth, x * metresPerPx, -y * metresPerPx, 0.5 * sidePx * metresPerPx, 0.5 * sidePx * metresPerPx,
                material);
  return scene;
}

double pixelsPerTangent(const host::Shot& shot) {
  return 0.5 * shot.height / std::tan(0.5 * shot.camera.fovyDeg * std::numbers::pi / 180.0);
}

double thinLensRadius(const host::Shot& shot, double depth) {
  return pixelsPerTangent(shot) * shot.lens.apertureRadius * (1.0 / shot.lens.focusDistance - 1.0 / depth);
}

}  // namespace lensgraph::support
