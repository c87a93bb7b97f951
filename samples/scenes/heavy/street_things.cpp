// Lamps, shops, trees, and what stands in front of the camera; see street.h.
#include <array>
#include <cstddef>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <string>
#include <vector>

#include "generate/random.h"
#include "heavy/street.h"
#include "parts/facade.h"
#include "parts/furniture.h"
#include "parts/plants.h"
#include "parts/shapes.h"
#include "parts/surfaces.h"

namespace scenes {

void addStreetLamps(Glb& glb, const StreetMaterials& materials) {
  const StreetLamp lamp = makeStreetLamp();
  const int metal = glb.addMesh("lamp post", lamp.metal, materials.iron, kTextured);
  const int globe = glb.addMesh("lamp globe", lamp.globe, materials.lamp, {.normals = true});
  for (int i = 0; i < 8; ++i) {
    const bool isLeft = i % 2 == 1;
    const glm::vec3 at((isLeft ? -1.0f : 1.0f) * (kRoadHalfWidth + 0.45f), 0.12f, -6.5f - 4.5f * static_cast<float>(i));
    glb.addNode("lamp post", metal, {.translation = at});
    glb.addNode("lamp globe", globe, {.translation = at});
    if (i >= 3) continue;  // The others are too far to light what one sees.
    glb.addLight({.name = "lamp", .type = "point", .color = {1.0f, 0.68f, 0.38f}, .intensity = 5.0f}, at + lamp.light,
                 at);
  }
  const Mesh bulb = makeSphere(8, 10);
  const int bulbs = glb.addMesh("bulb", bulb, materials.bulb, {.normals = true});
  Mesh cords;
  for (int i = 0; i < 5; ++i) {
    const float z = -5.0f - 5.2f * static_cast<float>(i);
    const LightString string = makeLightString({-kHalfWidth, 4.3f, z}, {kHalfWidth, 4.5f, z - 2.0f}, 0.85f, 11);
    append(cords, string.cord);
    for (const glm::vec3 at : string.bulbs) glb.addNode("bulb", bulbs, {.translation = at, .scale = 0.04f});
  }
  glb.add("cords", cords, materials.iron, kTextured);
}

void addShops(Glb& glb, const StreetMaterials& materials) {
  const std::array<int, 2> cloths = {addSurface(glb, "red cloth", clothRelief({0.72f, 0.22f, 0.16f}, 3), true),
                                     addSurface(glb, "cream cloth", clothRelief({0.86f, 0.80f, 0.64f}, 4), true)};
  const Mesh awning = makeAwning(2.0f);
  const std::array<int, 2> awnings = {glb.addMesh("awning", awning, cloths[0], kTextured),
                                      glb.addMesh("awning", awning, cloths[1], kTextured)};
  const HangingSign sign = makeHangingSign();
  const int signIron = glb.addMesh("sign bracket", sign.iron, materials.iron, kTextured);
  struct Words {
    const char *upper, *lower;
    glm::vec3 ground;
  };
  const std::array<Words, 3> words = {Words{"BAKERY", "SINCE 1887", {0.16f, 0.22f, 0.34f}},
                                      Words{"IRIS &", "APERTURE", {0.34f, 0.10f, 0.10f}},
                                      Words{"BOKEH", "BOOKS", {0.10f, 0.26f, 0.20f}}};
  std::vector<int> faces;
  for (const Words& text : words) {
    const int material = glb.addMaterial(
        {.name = text.upper,
         .texture = glb.addTexture(text.upper, paintSign(text.upper, text.lower, text.ground), Wrap::clamp),
         .unlit = false,
         .roughness = 0.4f});
    faces.push_back(glb.addMesh("sign", sign.faces, material, kTextured));
  }
  for (int i = 0; i < 16; ++i) {
    const bool isLeft = i % 2 == 0;
    const float z = 3.0f - kBayWidth * (static_cast<float>(i / 2) * 2.0f + 2.5f);
    const Placement at{.translation = {(isLeft ? -1.0f : 1.0f) * (kHalfWidth - 0.06f), 3.35f, z},
                       .rotation = turned(isLeft ? glm::half_pi<float>() : -glm::half_pi<float>())};
    glb.addNode("awning", awnings[static_cast<size_t>(i / 2 + i) % 2], at);
    if (i % 3 == 2) continue;
    const Placement hung{.translation = {at.translation.x, 3.0f, z - 1.25f},
                         .rotation = turned(isLeft ? 0.0f : glm::pi<float>())};
    glb.addNode("sign bracket", signIron, hung);
    glb.addNode("sign", faces[static_cast<size_t>(i) % faces.size()], hung);
  }
}

void addStreetTrees(Glb& glb, const StreetMaterials& materials) {
  Random random(31);
  const Plant tree = makeTree({.height = 5.6f,
                               .trunkRadius = 0.09f,
                               .branches = 16,
                               .twigs = 8,
                               .leaves = 14,
                               .leafSize = 0.13f,
                               .spread = 0.36f,
                               .leafTint = {0.50f, 0.62f, 0.22f}},
                              random);
  const int wood = glb.addMesh("tree", tree.wood, materials.bark, kTextured);
  const int leaves = glb.addMesh("leaves", tree.leaves, materials.leaf, kTinted);
  const int clay =
      glb.addMaterial({.name = "clay", .baseColor = {0.50f, 0.24f, 0.14f, 1}, .unlit = false, .roughness = 0.85f});
  const int tub = glb.addMesh("tub", makePot(0.6f), clay, {.normals = true});
  const std::array<glm::vec2, 5> places = {
      glm::vec2(-3.65f, -9.0f), {3.6f, -13.0f}, {-3.6f, -19.0f}, {3.6f, -23.0f}, {-3.6f, -29.0f}};
  for (size_t i = 0; i < places.size(); ++i) {
    const Placement at{.translation = {places[i].x, 0.12f, places[i].y},
                       .rotation = turned(1.3f * static_cast<float>(i))};
    glb.addNode("tub", tub, at);
    glb.addNode("tree", wood, {.translation = at.translation + glm::vec3(0, 0.4f, 0), .rotation = at.rotation});
    glb.addNode("leaves", leaves, {.translation = at.translation + glm::vec3(0, 0.4f, 0), .rotation = at.rotation});
  }
}

void addStreetSubject(Glb& glb, const StreetMaterials& materials) {
  const Board board = makeBoard(0.62f, 1.12f);
  const Placement boardAt{.translation = {-0.42f, 0.012f, -3.55f}, .rotation = turned(0.22f)};
  glb.addNode("board", glb.addMesh("board", board.frame, materials.boards, kTextured), boardAt);
  const int menu = glb.addMaterial(
      {.name = "menu", .texture = glb.addTexture("menu", paintMenu(), Wrap::clamp), .unlit = false, .roughness = 0.7f});
  glb.addNode("menu", glb.addMesh("menu", board.face, menu, kTextured), boardAt);

  const Placement crateAt{.translation = {0.28f, 0.012f, -3.45f}, .rotation = turned(-0.3f)};
  glb.addNode("crate", glb.addMesh("crate", makeCrate({0.24f, 0.2f, 0.18f}), materials.boards, kTextured), crateAt);
  const StreetLamp lantern = makeTableLantern();
  const glm::vec3 onCrate = crateAt.translation + glm::vec3(0.0f, 0.42f, 0.0f);
  glb.addNode("lantern", glb.addMesh("lantern", lantern.metal, materials.brass, kTextured), {.translation = onCrate});
  glb.addNode("flame", glb.addMesh("flame", lantern.globe, materials.lamp, {.normals = true}),
              {.translation = onCrate});
  glb.addLight({.name = "lantern", .type = "point", .color = {1.0f, 0.66f, 0.34f}, .intensity = 0.45f},
               onCrate + lantern.light, onCrate);

  Random random(17);
  const int clay = glb.addMaterial(
      {.name = "glazed clay", .baseColor = {0.09f, 0.17f, 0.26f, 1}, .unlit = false, .roughness = 0.25f});
  const glm::vec3 potAt(0.72f, 0.012f, -3.75f);
  glb.addNode("pot", glb.addMesh("pot", makePot(0.36f), clay, {.normals = true}), {.translation = potAt});
  Plant bush;
  for (int i = 0; i < 9; ++i) {
    const float angle = 0.7f * static_cast<float>(i);
    const Plant stem = makeBranch(random.between(0.4f, 0.6f), 0.075f, 9, 7, {0.36f, 0.58f, 0.26f}, random);
    const glm::mat4 place = glm::translate(glm::mat4(1.0f), potAt + glm::vec3(0, 0.3f, 0)) *
                            glm::rotate(glm::mat4(1.0f), angle, glm::vec3(0, 1, 0)) *
                            glm::rotate(glm::mat4(1.0f), random.between(0.9f, 1.35f), glm::vec3(0, 0, 1));
    append(bush.wood, transformed(stem.wood, place));
    append(bush.leaves, transformed(stem.leaves, place));
  }
  glb.add("bush stems", bush.wood, materials.bark, kTextured);
  glb.add("bush", bush.leaves, materials.leaf, kTinted);
}

void addStreetNear(Glb& glb, const StreetMaterials& materials) {
  Mesh railing = makeRailing(1.5f, 0.86f, 10, 4);
  scaleUv(railing, {1.0f, 3.0f});
  const int paint = addSurface(glb, "railing paint", ironRelief({0.86f, 0.84f, 0.78f}, 22));
  glb.addNode("near railing", glb.addMesh("near railing", railing, paint, kTextured),
              {.translation = {1.34f, 0.0f, -1.8f}, .rotation = turned(0.18f), .scale = 1.2f});
  Random random(6);
  const Plant branch = makeBranch(1.0f, 0.12f, 12, 7, {0.95f, 0.36f, 0.07f}, random);
  const Placement at{.translation = {-0.98f, 1.60f, -1.28f}, .rotation = turned(0.15f)};
  glb.addNode("near branch", glb.addMesh("near branch", branch.wood, materials.bark, kTextured), at);
  glb.addNode("near leaves", glb.addMesh("near leaves", branch.leaves, materials.leaf, kTinted), at);
}

}  // namespace scenes
