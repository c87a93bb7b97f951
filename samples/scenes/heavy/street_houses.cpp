// The house fronts on both sides and at the end of the street; see street.h.
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "generate/canvas.h"
#include "generate/random.h"
#include "heavy/street.h"
#include "parts/facade.h"
#include "parts/shapes.h"
#include "parts/surfaces.h"

namespace scenes {
namespace {

/// Lamp light behind curtains: emission of a window.
Canvas paintCurtains() {
  Canvas canvas(64, 128);
  canvas.paint([](glm::vec2 p) {
    const float fold = 0.75f + 0.25f * std::sin(p.x * 60.0f + 2.0f * std::sin(p.y * 3.0f));
    const float gap = std::abs(p.x - 0.5f) < 0.16f ? 1.0f : 0.62f * fold;
    return glm::vec4(glm::vec3(1.0f, 0.80f, 0.52f) * gap * (0.55f + 0.45f * p.y), 1.0f);
  });
  return canvas;
}

}  // namespace

void addStreetHouses(Glb& glb, const StreetMaterials& materials) {
  const int darkGlass =
      glb.addMaterial({.name = "window", .baseColor = {0.03f, 0.04f, 0.05f, 1}, .unlit = false, .roughness = 0.08f});
  const int litGlass = glb.addMaterial({.name = "lit window",
                                        .baseColor = {0.10f, 0.08f, 0.06f, 1},
                                        .unlit = false,
                                        .roughness = 0.1f,
                                        .emissive = glm::vec3(1.0f),
                                        .emissiveStrength = 2.2f,
                                        .emissiveTexture = glb.addTexture("curtains", paintCurtains(), Wrap::clamp)});
  FacadeParts parts(glb, {materials.granite, materials.iron, darkGlass, litGlass});
  const std::array<int, 4> walls = {addSurface(glb, "ochre plaster", plasterRelief({0.86f, 0.68f, 0.42f}, 51)),
                                    addSurface(glb, "red brick", brickRelief({0.62f, 0.30f, 0.22f}, 61)),
                                    addSurface(glb, "rose plaster", plasterRelief({0.84f, 0.58f, 0.50f}, 71)),
                                    addSurface(glb, "gray plaster", plasterRelief({0.72f, 0.74f, 0.70f}, 81))};
  const std::array<float, 4> tiles = {2.0f, 1.0f, 2.0f, 2.0f};
  const std::array<int, 3> paints = {addSurface(glb, "green paint", boardRelief({0.24f, 0.42f, 0.36f}, 91)),
                                     addSurface(glb, "white paint", boardRelief({0.88f, 0.86f, 0.80f}, 92)),
                                     addSurface(glb, "blue paint", boardRelief({0.30f, 0.42f, 0.60f}, 93))};
  const std::array<int, 6> bays = {3, 4, 3, 2, 4, 3};
  Random random(4711);
  for (const bool isLeft : {true, false}) {
    float z = 3.0f;
    for (size_t i = 0; i < bays.size(); ++i) {
      const int count = bays[isLeft ? i : bays.size() - 1 - i];
      const size_t kind = (i * 3 + (isLeft ? 0 : 1)) % 4;
      const float length = kBayWidth * static_cast<float>(count);
      const House house{.name = isLeft ? "left house" : "right house",
                        .wall = walls[kind],
                        .metersPerTile = tiles[kind],
                        .paint = paints[(i + (isLeft ? 0u : 2u)) % 3],
                        .bays = count,
                        .floors = 3,
                        .balconyShare = 0.28f};
      const Placement at =
          isLeft ? Placement{.translation = {-kHalfWidth, 0, z}, .rotation = turned(glm::half_pi<float>())}
                 : Placement{.translation = {kHalfWidth, 0, z - length}, .rotation = turned(-glm::half_pi<float>())};
      addHouse(glb, parts, house, at, random);
      z -= length;
    }
  }
  const House end{.name = "end house",
                  .wall = walls[3],
                  .metersPerTile = 2.0f,
                  .paint = paints[0],
                  .bays = 4,
                  .floors = 1,
                  .balconyShare = 0.5f};
  addHouse(glb, parts, end, {.translation = {-2.0f * kBayWidth, 0, -kStreetLength + 4.0f}}, random);
}

}  // namespace scenes
