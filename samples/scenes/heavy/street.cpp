// An old street in the last sun: houses with balconies, cobbles, lamps, trees, strings of bulbs. In focus at 3.5 m stands
// a café's board beside a lantern; a railing and a branch are close to the lens.
#include "heavy/street.h"

#include <glm/vec3.hpp>

#include "heavy/heavy_scenes.h"
#include "parts/plants.h"
#include "parts/surface_maps.h"
#include "parts/surfaces.h"

namespace scenes {
namespace {

StreetMaterials addMaterials(Glb& glb) {
  StreetMaterials m{};
  m.granite = addSurface(glb, "granite", graniteRelief(11));
  m.iron = addSurface(glb, "iron", ironRelief({0.10f, 0.13f, 0.12f}, 21));
  m.brass = addSurface(glb, "brass", brassRelief(5));
  m.boards = addSurface(glb, "boards", boardRelief({0.55f, 0.40f, 0.26f}, 31));
  m.bark = addSurface(glb, "bark", barkRelief(41));
  m.leaf = glb.addMaterial({.name = "leaf",
                            .texture = glb.addTexture("leaf", paintLeafTexture(), Wrap::clamp, true),
                            .alphaMode = AlphaMode::mask,
                            .doubleSided = true,
                            .unlit = false,
                            .roughness = 0.6f});
  const auto glowing = [&glb](const char* name, glm::vec3 color, float strength) {
    return glb.addMaterial(
        {.name = name, .baseColor = {0, 0, 0, 1}, .unlit = false, .emissive = color, .emissiveStrength = strength});
  };
  m.bulb = glowing("bulb", {1.0f, 0.66f, 0.30f}, 22.0f);
  m.lamp = glowing("lamp", {1.0f, 0.70f, 0.38f}, 18.0f);
  return m;
}

}  // namespace

HeavyScene makeStreet() {
  HeavyScene heavy;
  heavy.name = "street";
  heavy.sky = {.zenith = {0.16f, 0.26f, 0.48f},
               .horizon = {0.85f, 0.55f, 0.34f},
               .ground = {0.16f, 0.13f, 0.11f},
               .towardsSun = {0.35f, 0.22f, -1.0f},
               .glow = {1.0f, 0.55f, 0.25f}};
  Glb& glb = heavy.scene.glb;
  const StreetMaterials materials = addMaterials(glb);
  addStreetHouses(glb, materials);
  addStreetGround(glb, materials);
  addStreetLamps(glb, materials);
  addShops(glb, materials);
  addStreetTrees(glb, materials);
  addStreetSubject(glb, materials);
  addStreetNear(glb, materials);
  addSkyDome(glb, heavy.sky, 150.0f);
  glb.addLight({.name = "sun", .type = "directional", .color = {1.0f, 0.74f, 0.48f}, .intensity = 1.6f}, kTowardsSun,
               glm::vec3(0.0f));

  Shot shot;
  shot.name = heavy.name;
  shot.description = "a street in the evening: board in focus at 3.5 m, railing and branch close, lamps far";
  shot.camera = {.position = {0.30f, 1.25f, 0.0f}, .target = {0.02f, 1.02f, -3.5f}, .fovyDeg = 36.0f};
  shot.lens = {.apertureRadius = 0.066, .focusDistance = 3.5};
  shot.background = {0.5, 0.4, 0.35};
  shot.lit = true;
  shot.environment = heavy.name + "_sky.exr";
  heavy.scene.shots.push_back(shot);
  return heavy;
}

}  // namespace scenes
