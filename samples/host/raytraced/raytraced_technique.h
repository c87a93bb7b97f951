// `raytraced` among the techniques: its name and parameters as configuration gives them, and a shot's lens in the ray
// tracer's terms. It declares nothing in a render graph, so passes/registry does not list it.
#pragma once

#include "engine/raytracer/ray_lens.h"
#include "engine/raytracer/ray_tracer_options.h"
#include "passes/lens/physical_lens.h"
#include "passes/parameters.h"
#include "passes/technique.h"

namespace lensgraph::host {

struct RaytracedParameters {
  int samples = 256;  ///< 1…1048576 rays a pixel; time is proportional to it.
  engine::PixelFilter pixelFilter = engine::PixelFilter::box;
  int seed = 0;     ///< 0…2147483647; another seed is another noise.
  int threads = 0;  ///< 0…1024; 0: one for each core. Changes no picture.
};

/// The entry for lists of techniques. Its `configure` is empty.
const passes::Technique& raytracedTechnique();

/// Absent ones take their defaults. Precondition: passes::check() found no problem.
RaytracedParameters raytracedParameters(const passes::ParameterSet& set);

/// Computed from the lens' numbers, not by the functions of passes/lens. Precondition: passes::validate() found nothing.
engine::RayLens rayLensOf(const passes::Lens& lens);

}  // namespace lensgraph::host
