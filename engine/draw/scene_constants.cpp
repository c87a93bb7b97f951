// Computes matrices, lights and rotation in double from the scene and its viewpoint, and rounds them to shader constants.
#include "engine/draw/scene_constants.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_inverse.hpp>
#include <glm/matrix.hpp>

namespace lensgraph::engine {
namespace {

shared::vec4 toShared(const glm::dvec3& v, double w) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), static_cast<float>(w)};
}

}  // namespace

bool drawsBothFaces(const SceneViewpoint& viewpoint, const SceneDrawItem& item) {
  return viewpoint.faces == DrawnFaces::both || item.doubleSided || item.winding == Winding::lost;
}

shared::DrawConstants drawConstantsOf(const SceneViewpoint& viewpoint, const SceneDrawItem& item) {
  glm::dmat4 viewFromObject = viewpoint.viewFromWorld * item.worldFromObject;
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 3; ++row) viewFromObject[column][row] *= viewpoint.metersPerUnit;
  }
  shared::DrawConstants constants{};
  for (int i = 0; i < 16; ++i) constants.viewFromObject.columns[i] = static_cast<float>(viewFromObject[i / 4][i % 4]);
  // A matrix that squashes a dimension has no inverse; its cofactors are the normal transform all the same.
  const glm::dmat3 m(viewFromObject);
  constants.normalColumns[0] = toShared(glm::cross(m[1], m[2]), item.winding == Winding::turned ? 1.0 : 0.0);
  constants.normalColumns[1] = toShared(glm::cross(m[2], m[0]), 0.0);
  constants.normalColumns[2] = toShared(glm::cross(m[0], m[1]), 0.0);
  constants.material = item.material;
  constants.bothFaces = drawsBothFaces(viewpoint, item) ? 1u : 0u;
  return constants;
}

shared::LightConstants lightConstantsOf(const SceneViewpoint& viewpoint, const Light& light) {
  const glm::dmat4 viewFromLight = viewpoint.viewFromWorld * light.worldFromLight;
  shared::LightConstants constants{};
  const auto color = glm::dvec3(light.color) * static_cast<double>(light.intensity);
  constants.color = toShared(color, static_cast<double>(static_cast<uint32_t>(light.type)));
  const double range = light.range ? static_cast<double>(*light.range) * viewpoint.metersPerUnit : 0.0;
  constants.position = toShared(glm::dvec3(viewFromLight[3]) * viewpoint.metersPerUnit, range);
  constants.direction = toShared(-glm::normalize(glm::dvec3(viewFromLight[2])), 0.0);
  const double inner = std::cos(static_cast<double>(light.innerConeAngle));
  const double outer = std::cos(static_cast<double>(light.outerConeAngle));
  const double scale = 1.0 / std::max(0.001, inner - outer);
  constants.cone = {static_cast<float>(scale), static_cast<float>(-outer * scale), 0.0f, 0.0f};
  return constants;
}

void fillViewpoint(shared::SceneConstants& constants, const SceneViewpoint& viewpoint) {
  const glm::dmat3 viewFromWorld(viewpoint.viewFromWorld);
  // The inverse of a rotation is its transpose: row i of world-from-view is column i of view-from-world.
  for (int i = 0; i < 3; ++i) constants.worldFromViewRows[i] = toShared(viewFromWorld[i], 0.0);
}

}  // namespace lensgraph::engine
