// What a ray-traced picture depends on, as names and values, for its state file.
#pragma once

#include "engine/draw/environment.h"
#include "engine/raytracer/picture_state.h"
#include "engine/raytracer/ray_lens.h"
#include "engine/raytracer/ray_tracer_options.h"
#include "engine/scene/scene.h"

namespace lensgraph::engine {

/// Everything that decides a sample's bits: scene (with lights and textures), camera, lens, size, shading, background,
/// environment, pixel filter, seed. The number of samples is not part of it: a finished picture may be given more.
StateIdentity stateIdentity(const Scene& scene, const Environment* environment, const RayTracedView& view,
                            const RayTracerOptions& options);

}  // namespace lensgraph::engine
