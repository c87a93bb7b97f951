// Distributed ray tracing (Cook, Porter and Carpenter 1984) of a scene through a thin lens, on the CPU: the independent
// truth for everything that the render graph draws.
//
// With the rasterized path it shares the scene as the loader made it (engine/scene, transformUv() included), the prepared
// environment map, and the numbers of lens and camera; neither projection, lens formulas, aperture shapes, sample
// patterns, visibility nor shading code. README.md in this folder says how it samples and how near the two come.
//
// Light is not traced any further than to the first opaque surface: surfaces radiate as the project's unlit and lit modes
// say, without shadows, reflections of other surfaces, or refraction.
#pragma once

#include <optional>

#include "engine/draw/environment.h"
#include "engine/image/image.h"
#include "engine/raytracer/ray_lens.h"
#include "engine/raytracer/ray_tracer_options.h"
#include "engine/scene/scene.h"

namespace lensgraph::engine {

/// View depth where nothing is hit, m.
inline constexpr float kNoDepth = 1e10f;

struct RayTracedPicture {
  FloatImage color;  ///< Linear RGBA, alpha 1.
  /// Pinhole view depth in m at the pixel's center, of opaque and alpha-masked surfaces, one channel; kNoDepth where
  /// nothing is hit. Empty unless asked for.
  FloatImage depth;
  uint32_t samples = 0;          ///< Of each pixel.
  uint64_t replacedSamples = 0;  ///< Samples whose radiance was not finite; they count as black.
};

/// Traces the picture. The same arguments give the same bits, whatever the number of threads and however often it was
/// interrupted. Memory: 40 bytes a pixel, and for the copied triangles with their hierarchy some 150 bytes each.
/// Preconditions: findProblems(scene) is empty; the view's ranges hold. Throws Error: the checkpoint is that of another
/// picture (bad input), memory or disk are full (failed).
RayTracedPicture traceRays(const Scene& scene, const Environment* environment, const RayTracedView& view,
                           const RayTracerOptions& options);

/// Name and version of the library that finds the hits: "Embree 3.13.5".
const char* rayTracingLibrary();

}  // namespace lensgraph::engine
