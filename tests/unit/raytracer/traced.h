// Small scenes and views for tests of the ray tracer, whose pictures are known in closed form.
#pragma once

#include <array>
#include <cmath>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <numbers>

#include "engine/raytracer/ray_tracer.h"

namespace lensgraph::test {

/// An unlit material; alpha below 1 blends. Front faces only.
inline uint32_t addMaterial(engine::Scene& scene, const glm::vec4& color) {
  engine::Material material;
  material.baseColorFactor = color;
  material.unlit = true;
  material.alphaMode = color.a < 1.0f ? engine::AlphaMode::blend : engine::AlphaMode::opaque;
  scene.materials.push_back(material);
  return static_cast<uint32_t>(scene.materials.size() - 1);
}

/// A quad across the axis at view depth `depth`, center (x, y) and half sizes in metres; it faces the camera.
inline void addQuad(engine::Scene& scene, double depth, double x, double y, double halfWidth, double halfHeight,
                    uint32_t material) {
  const auto z = static_cast<float>(-depth);
  const auto left = static_cast<float>(x - halfWidth), right = static_cast<float>(x + halfWidth);
  const auto bottom = static_cast<float>(y - halfHeight), top = static_cast<float>(y + halfHeight);
  engine::Primitive quad;
  quad.positions = {{left, bottom, z}, {right, bottom, z}, {right, top, z}, {left, top, z}};
  quad.normals.assign(4, glm::vec3(0.0f, 0.0f, 1.0f));
  quad.uvs[0] = {{0.0f, 1.0f}, {1.0f, 1.0f}, {1.0f, 0.0f}, {0.0f, 0.0f}};
  quad.indices = {0, 1, 2, 0, 2, 3};
  quad.material = material;
  for (const auto& position : quad.positions) quad.bounds.add(position);
  scene.primitives.push_back(quad);
  scene.instances.push_back({.primitive = static_cast<uint32_t>(scene.primitives.size() - 1),
                             .worldFromObject = glm::dmat4(1.0),
                             .name = "quad"});
}

/// Camera at the origin looking down -Z, 40 degrees high; aperture 0.02 m, focus 2 m; both faces; black background.
inline engine::RayTracedView smallView(uint32_t width, uint32_t height) {
  engine::RayTracedView view;
  view.viewpoint.faces = engine::DrawnFaces::both;
  view.lens.apertureRadius = 0.02;
  view.lens.focusDistance = 2.0;
  view.width = width;
  view.height = height;
  return view;
}

/// Pixels of the pinhole picture for a tangent of 1.
inline double pixelsPerTangent(const engine::RayTracedView& view) {
  return view.height / 2.0 / std::tan(view.camera.fovy / 2.0);
}

/// Radius of a point's blur by the thin-lens formula, px.
inline double blurRadius(const engine::RayTracedView& view, double depth) {
  return pixelsPerTangent(view) * view.lens.apertureRadius * std::abs(1.0 / view.lens.focusDistance - 1.0 / depth);
}

/// A square white light of radiance 1, `side` px wide in the pinhole picture, `x`, `y` px from its center (y down).
inline engine::Scene lightScene(const engine::RayTracedView& view, double depth, double side, double x = 0.0,
                                double y = 0.0) {
  engine::Scene scene;
  const double pixel = depth / pixelsPerTangent(view);
  addQuad(scene, depth, x * pixel, -y * pixel, 0.5 * side * pixel, 0.5 * side * pixel,
          addMaterial(scene, {1.0f, 1.0f, 1.0f, 1.0f}));
  return scene;
}

inline engine::RayTracedPicture trace(const engine::Scene& scene, const engine::RayTracedView& view, uint32_t samples,
                                      engine::PixelFilter filter = engine::PixelFilter::box) {
  engine::RayTracerOptions options;
  options.samples = samples;
  options.filter = filter;
  options.wantDepth = true;
  return engine::traceRays(scene, nullptr, view, options);
}

/// Moments of the red channel: all its light, centroid and variances in px.
struct Moments {
  double flux = 0.0, x = 0.0, y = 0.0, varianceX = 0.0, varianceY = 0.0, thirdY = 0.0;
};

inline Moments momentsOf(const engine::FloatImage& picture) {
  Moments m;
  const auto sum = [&](const auto& term) {
    double total = 0.0;
    for (uint32_t y = 0; y < picture.height; ++y) {
      for (uint32_t x = 0; x < picture.width; ++x) {
        total += static_cast<double>(picture.pixel(x, y)[0]) * term(x + 0.5, y + 0.5);
      }
    }
    return total;
  };
  m.flux = sum([](double, double) { return 1.0; });
  m.x = sum([](double x, double) { return x; }) / m.flux;
  m.y = sum([](double, double y) { return y; }) / m.flux;
  m.varianceX = sum([&](double x, double) { return (x - m.x) * (x - m.x); }) / m.flux;
  m.varianceY = sum([&](double, double y) { return (y - m.y) * (y - m.y); }) / m.flux;
  m.thirdY = sum([&](double, double y) { return std::pow(y - m.y, 3.0); }) / m.flux;
  return m;
}

}  // namespace lensgraph::test
