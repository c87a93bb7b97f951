// Rays through pixel centers against every triangle, found by the triangle's box in the picture. See depth_complexity.h.
#include "heavy/depth_complexity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace scenes {
namespace {

constexpr float kNearPlane = 0.01f;  // m, the renderer's default.

/// A triangle in view space (x right, y up, z forwards), and where its corners are seen.
struct Seen {
  std::array<glm::vec3, 3> corners;
  glm::ivec2 low, high;  ///< Pixels, inclusive; low > high where nothing is seen.
};

Seen seenFrom(const Glb::Triangle& triangle, const glm::mat3& viewAxes, glm::vec3 eye, glm::vec2 tangents,
              glm::ivec2 size) {
  Seen seen{{}, glm::ivec2(0), size - 1};
  glm::vec2 low(1e9f), high(-1e9f);
  bool crossesNearPlane = false;
  for (size_t i = 0; i < 3; ++i) {
    seen.corners[i] = (triangle[i] - eye) * viewAxes;  // Rows: the dot product with each axis.
    if (seen.corners[i].z < kNearPlane) {
      crossesNearPlane = true;
      continue;
    }
    const glm::vec2 at = glm::vec2(seen.corners[i]) / (seen.corners[i].z * tangents);
    const glm::vec2 pixel = glm::vec2(0.5f + 0.5f * at.x, 0.5f - 0.5f * at.y) * glm::vec2(size);
    low = glm::min(low, pixel);
    high = glm::max(high, pixel);
  }
  if (high.x < low.x) return {seen.corners, glm::ivec2(1), glm::ivec2(0)};  // All behind the camera.
  // Of one that crosses the near plane, the box of its visible corners is too small: all pixels are tried.
  if (crossesNearPlane) return seen;
  seen.low = glm::ivec2(glm::clamp(low, glm::vec2(0.0f), glm::vec2(size)));
  seen.high = glm::ivec2(glm::clamp(high, glm::vec2(-1.0f), glm::vec2(size - 1)));
  return seen;
}

/// Whether the ray from the origin meets the front; the triple products are six times the volumes of the tetrahedra.
bool meetsFront(const std::array<glm::vec3, 3>& corners, glm::vec3 ray) {
  // The view's axes are left-handed (z forwards), so counter-clockwise fronts have positive products.
  return glm::dot(ray, glm::cross(corners[0], corners[1])) > 0.0f &&
         glm::dot(ray, glm::cross(corners[1], corners[2])) > 0.0f &&
         glm::dot(ray, glm::cross(corners[2], corners[0])) > 0.0f;
}

}  // namespace

double DepthComplexity::mean() const {
  double sum = 0.0;
  for (const int count : surfaces) sum += count;
  return surfaces.empty() ? 0.0 : sum / static_cast<double>(surfaces.size());
}

double DepthComplexity::shareOfAtLeast(int count) const {
  const auto enough = std::ranges::count_if(surfaces, [count](int found) { return found >= count; });
  return surfaces.empty() ? 0.0 : static_cast<double>(enough) / static_cast<double>(surfaces.size());
}

DepthComplexity depthComplexityOf(const Glb& scene, const Camera& camera, int width) {
  const glm::ivec2 size(width, width * 9 / 16);
  DepthComplexity complexity{size.x, size.y,
                             std::vector<int>(static_cast<size_t>(size.x) * static_cast<size_t>(size.y), 0)};
  const glm::vec3 forward = glm::normalize(camera.target - camera.position);
  const glm::vec3 right = glm::normalize(glm::cross(forward, glm::vec3(0, 1, 0)));
  const glm::mat3 axes(right, glm::cross(right, forward), forward);
  const float tangentY = std::tan(glm::radians(camera.fovyDeg) * 0.5f);
  const glm::vec2 tangents(tangentY * static_cast<float>(size.x) / static_cast<float>(size.y), tangentY);
  for (const Glb::Triangle& triangle : scene.worldTriangles()) {
    const Seen seen = seenFrom(triangle, axes, camera.position, tangents, size);
    for (int y = seen.low.y; y <= seen.high.y; ++y) {
      for (int x = seen.low.x; x <= seen.high.x; ++x) {
        const glm::vec2 at = (glm::vec2(x, y) + 0.5f) / glm::vec2(size);
        const glm::vec3 ray(tangents * glm::vec2(2.0f * at.x - 1.0f, 1.0f - 2.0f * at.y), 1.0f);
        if (meetsFront(seen.corners, ray)) ++complexity.surfaces[static_cast<size_t>(y * size.x + x)];
      }
    }
  }
  return complexity;
}

}  // namespace scenes
