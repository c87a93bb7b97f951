// Sutherland-Hodgman clipping of every triangle against the near plane and the four sides.
#include "engine/visible_range.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

namespace engine {
namespace {

/// Half-space dot(plane.xyz, p) + plane.w ≥ 0 in view space.
using Planes = std::array<glm::dvec4, 5>;

Planes frustum(const Camera& camera, uint32_t width, uint32_t height, double marginPx) {
  const double s = pixelsPerTangent(camera, height);
  const double x = (0.5 * width + marginPx) / s;
  const double y = (0.5 * height + marginPx) / s;
  return {glm::dvec4(0, 0, -1, -camera.nearPlane), glm::dvec4(-1, 0, -x, 0), glm::dvec4(1, 0, -x, 0),
          glm::dvec4(0, -1, -y, 0), glm::dvec4(0, 1, -y, 0)};
}

double distance(const glm::dvec4& plane, const glm::dvec3& p) {
  return glm::dot(glm::dvec3(plane), p) + plane.w;
}

/// A triangle clipped by five planes has at most eight corners.
struct Polygon {
  std::array<glm::dvec3, 10> corners;
  std::size_t count = 0;
  void add(const glm::dvec3& corner) { corners[count++] = corner; }
};

Polygon clipped(const Polygon& in, const glm::dvec4& plane) {
  Polygon out;
  for (std::size_t i = 0; i < in.count; ++i) {
    const glm::dvec3& a = in.corners[i];
    const glm::dvec3& b = in.corners[(i + 1) % in.count];
    const double da = distance(plane, a), db = distance(plane, b);
    if (da >= 0.0) out.add(a);
    if ((da >= 0.0) != (db >= 0.0)) out.add(a + (b - a) * (da / (da - db)));
  }
  return out;
}

void include(VisibleRange& range, double depth) {
  range.nearestDepth = range.isEmpty ? depth : std::min(range.nearestDepth, depth);
  range.farthestDepth = range.isEmpty ? depth : std::max(range.farthestDepth, depth);
  range.isEmpty = false;
}

void includeTriangle(VisibleRange& range, const Planes& planes, const glm::dvec3 (&corners)[3]) {
  Polygon polygon;
  for (const auto& corner : corners) polygon.add(corner);
  for (const auto& plane : planes) {
    bool allInside = true, allOutside = true;
    for (std::size_t i = 0; i < polygon.count; ++i) {
      const bool inside = distance(plane, polygon.corners[i]) >= 0.0;
      allInside &= inside;
      allOutside &= !inside;
    }
    if (allOutside) return;
    if (!allInside) polygon = clipped(polygon, plane);
  }
  for (std::size_t i = 0; i < polygon.count; ++i) include(range, -polygon.corners[i].z);
}

}  // namespace

VisibleRange visibleRange(const Scene& scene, const Camera& camera, uint32_t width, uint32_t height, double marginPx,
                          double metersPerUnit) {
  const Planes planes = frustum(camera, width, height, marginPx);
  VisibleRange range;
  std::vector<glm::dvec3> inView;
  for (const auto& instance : scene.instances) {
    const auto& primitive = scene.primitives[instance.primitive];
    const glm::dmat4 viewFromObject = camera.viewFromWorld * instance.worldFromObject;
    inView.clear();
    for (const auto& p : primitive.positions) {
      inView.push_back(metersPerUnit * glm::dvec3(viewFromObject * glm::dvec4(p, 1.0)));
    }
    for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
      const glm::dvec3 corners[3] = {inView[primitive.indices[i]], inView[primitive.indices[i + 1]],
                                     inView[primitive.indices[i + 2]]};
      includeTriangle(range, planes, corners);
    }
  }
  return range;
}

}  // namespace engine
