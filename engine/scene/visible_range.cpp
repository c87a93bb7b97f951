// Sutherland-Hodgman clipping of every triangle against the near plane and the four sides.
//
// A lens point at distance r from the centre sees the picture's edge, w/2 px, where S x/d = w/2 + S r |V_f - 1/d|, that is
// x = (w/2S) d + r |V_f d - 1|: a plane in front of the focal plane and another behind it, so triangles are cut there.
#include "engine/scene/visible_range.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

namespace lensgraph::engine {
namespace {

constexpr std::size_t kMostSpans = 64;

/// Half-space dot(plane.xyz, p) + plane.w ≥ 0 in view space.
using Planes = std::vector<glm::dvec4>;

/// What is seen on one side of the focal plane (`side` 1: in front of it, -1: behind), bounded by it.
Planes frustum(const Camera& camera, uint32_t width, uint32_t height, const LensOpening& opening, double side) {
  const double s = pixelsPerTangent(camera, height);
  const double slope = side * opening.radius * opening.focusVergence;
  const double offset = side * opening.radius;
  const double x = 0.5 * width / s - slope;
  const double y = 0.5 * height / s - slope;
  Planes planes = {glm::dvec4(0, 0, -1, -camera.nearPlane), glm::dvec4(-1, 0, -x, offset), glm::dvec4(1, 0, -x, offset),
                   glm::dvec4(0, -1, -y, offset), glm::dvec4(0, 1, -y, offset)};
  if (opening.focusVergence > 0.0 && opening.radius > 0.0) {
    planes.emplace_back(0, 0, side, side / opening.focusVergence);
  }
  return planes;
}

double distance(const glm::dvec4& plane, const glm::dvec3& p) {
  return glm::dot(glm::dvec3(plane), p) + plane.w;
}

/// A triangle clipped by six planes has at most nine corners.
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

/// Adds the depths of what is left of a triangle inside the planes.
void includeTriangle(std::vector<DepthSpan>& spans, const Planes& planes, const glm::dvec3 (&corners)[3]) {
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
  if (polygon.count == 0) return;
  DepthSpan span{-polygon.corners[0].z, -polygon.corners[0].z};
  for (std::size_t i = 1; i < polygon.count; ++i) {
    span.nearest = std::min(span.nearest, -polygon.corners[i].z);
    span.farthest = std::max(span.farthest, -polygon.corners[i].z);
  }
  spans.push_back(span);
}

/// Their union, disjoint and nearest first.
void unite(std::vector<DepthSpan>& spans) {
  std::ranges::sort(spans, {}, &DepthSpan::nearest);
  std::size_t count = 0;
  for (const DepthSpan& span : spans) {
    if (count > 0 && span.nearest <= spans[count - 1].farthest) {
      spans[count - 1].farthest = std::max(spans[count - 1].farthest, span.farthest);
    } else {
      spans[count++] = span;
    }
  }
  spans.resize(count);
}

void closeSmallGaps(std::vector<DepthSpan>& spans) {
  if (spans.size() <= kMostSpans) return;
  const auto gapBefore = [&](std::size_t i) { return 1.0 / spans[i - 1].farthest - 1.0 / spans[i].nearest; };
  std::vector<double> gaps;
  for (std::size_t i = 1; i < spans.size(); ++i) gaps.push_back(gapBefore(i));
  std::ranges::nth_element(gaps, gaps.begin() + (kMostSpans - 1), std::greater<>());
  const double least = gaps[kMostSpans - 1];  // 63 gaps at most are wider
  std::vector<DepthSpan> wider = {spans[0]};
  for (std::size_t i = 1; i < spans.size(); ++i) {
    if (gapBefore(i) > least) {
      wider.push_back(spans[i]);
    } else {
      wider.back().farthest = spans[i].farthest;
    }
  }
  spans = std::move(wider);
}

}  // namespace

VisibleRange visibleRange(const Scene& scene, const Camera& camera, uint32_t width, uint32_t height,
                          const LensOpening& opening, double metersPerUnit) {
  const Planes sides[] = {frustum(camera, width, height, opening, 1.0), frustum(camera, width, height, opening, -1.0)};
  const std::size_t sideCount = sides[0].size() > 5 ? 2 : 1;
  // Focus at infinity has no far side: everything is in front of it.
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
      for (std::size_t side = 0; side < sideCount; ++side) includeTriangle(range.spans, sides[side], corners);
    }
  }
  if (range.spans.empty()) return range;
  unite(range.spans);
  range.isEmpty = false;
  range.nearestDepth = range.spans.front().nearest;
  range.farthestDepth = range.spans.back().farthest;
  closeSmallGaps(range.spans);
  return range;
}

}  // namespace lensgraph::engine
