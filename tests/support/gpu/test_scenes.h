// Scenes of a few quads, made in memory, whose pictures are known in closed form.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "engine/scene/scene.h"
#include "samples/host/shot.h"

namespace lensgraph::support {

/// An unlit material of this colour; alpha below 1 blends.
uint32_t addMaterial(engine::Scene& scene, const glm::vec4& color);

/// A quad with these corners, in order.
void addQuad(engine::Scene& scene, const std::array<glm::vec3, 4>& corners, uint32_t material);

/// A quad that faces the camera at view depth `depth`, centre (x, y) and half sizes in metres.
void addFacingQuad(engine::Scene& scene, double depth, double x, double y, double halfWidth, double halfHeight,
                   uint32_t material);

/// Camera at the origin looking down -Z; small picture, unlit, aperture 0.02 m, focus 2 m, black background.
host::Shot smallShot(int width, int height);

/// Near bar, focused checker, far wall: something at every depth, every pixel covered.
engine::Scene layeredScene();

/// A wall of one colour everywhere, in three slanted pieces with the same colour behind.
engine::Scene constantScene(const glm::vec3& color);

}  // namespace lensgraph::support
