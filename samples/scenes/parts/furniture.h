// What stands and hangs in the street: lamps, boards, pots, awnings, strings of bulbs, cobbles. Each stands on y = 0 about
// the origin unless it says otherwise; meshes that several materials need come in parts.
#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "generate/canvas.h"
#include "generate/mesh.h"
#include "generate/random.h"

namespace scenes {

/// A cast post 3.4 m high with a hexagonal lantern: the metal, and the globe of light in it.
struct StreetLamp {
  Mesh metal;
  Mesh globe;
  glm::vec3 light;  ///< Where its light comes from.
};
StreetLamp makeStreetLamp();

/// A brass lantern 0.34 m high, its globe, as above.
StreetLamp makeTableLantern();

/// A board on two pairs of legs, leaning back: the wooden frame, and the written face, UV [0, 1]².
struct Board {
  Mesh frame;
  Mesh face;
};
Board makeBoard(float width, float height);
Canvas paintMenu();

/// A sign on a bracket that reaches out along +X at y = 0: iron, and the two faces, UV [0, 1]².
struct HangingSign {
  Mesh iron;
  Mesh faces;
};
HangingSign makeHangingSign();
Canvas paintSign(const std::string& upper, const std::string& lower, glm::vec3 ground);

Mesh makePot(float height);
Mesh makeCrate(glm::vec3 halfSize);
/// Cloth over a shop window: `width` along X, hanging out along +Z from y = 0, with a scalloped edge.
Mesh makeAwning(float width);

/// A cord between two hooks and where its bulbs hang.
struct LightString {
  Mesh cord;
  std::vector<glm::vec3> bulbs;
};
LightString makeLightString(glm::vec3 from, glm::vec3 to, float sag, int bulbs);

/// A square meter of cobbles, 8 × 8 stones, from its corner on towards +X and −Z. lightAt: share of the light that
/// arrives at (x, z); it and the stones' tones are in the vertex colors.
Mesh makeCobblePatch(glm::vec2 corner, const std::function<float(glm::vec2)>& lightAt, Random& random);

}  // namespace scenes
