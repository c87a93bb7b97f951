// An old street in the last sun: houses with balconies, cobbles, lamps, trees, strings of bulbs. In focus at 3.5 m stands
// a café's board beside a lantern; a railing and a branch are close to the lens.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <string>
#include <vector>

#include "heavy/facade.h"
#include "heavy/furniture.h"
#include "heavy/heavy_scenes.h"
#include "heavy/plants.h"
#include "heavy/shapes.h"
#include "heavy/surfaces.h"

namespace scenes {
namespace {

constexpr float kHalfWidth = 4.5f;      // m, to the houses
constexpr float kRoadHalfWidth = 3.0f;  // m, to the kerb
constexpr int kCobbledLength = 14;      // m of real stones; beyond them a texture.
constexpr float kLength = 46.0f;        // m
const glm::vec3 kTowardsSun(0.8f, 0.7f, 0.9f);
constexpr Attributes kTextured{.normals = true, .uvs = true};
constexpr Attributes kTinted{.normals = true, .uvs = true, .colors = true};

glm::quat turned(float yaw) {
  return glm::angleAxis(yaw, glm::vec3(0, 1, 0));
}

struct StreetMaterials {
  int granite, iron, brass, boards, leaf, bark, bulb, lamp;
};

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

void addHouses(Glb& glb, const StreetMaterials& materials) {
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
                                    addSurface(glb, "grey plaster", plasterRelief({0.72f, 0.74f, 0.70f}, 81))};
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
                        .metresPerTile = tiles[kind],
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
                  .metresPerTile = 2.0f,
                  .paint = paints[0],
                  .bays = 4,
                  .floors = 1,
                  .balconyShare = 0.5f};
  addHouse(glb, parts, end, {.translation = {-2.0f * kBayWidth, 0, -kLength + 4.0f}}, random);
}

/// Something that keeps the sun from the ground: a foot, and a shadow that runs from it as wide as it is.
struct Blocker {
  glm::vec2 at;
  float radius;  ///< m
  float height;  ///< m
};

/// Share of the light that reaches the ground. Nothing else casts shadows, so those that matter are in vertex colors.
float lightOnGround(glm::vec2 point) {
  static constexpr std::array<Blocker, 8> kBlockers = {
      Blocker{{0.28f, -3.45f}, 0.24f, 0.42f}, {{-0.42f, -3.60f}, 0.26f, 1.1f}, {{-0.22f, -3.64f}, 0.22f, 1.1f},
      {{-0.60f, -3.56f}, 0.22f, 1.1f},        {{0.72f, -3.75f}, 0.2f, 0.8f},   {{3.45f, -6.5f}, 0.07f, 3.4f},
      {{3.45f, -15.5f}, 0.07f, 3.4f},         {{3.6f, -13.0f}, 0.55f, 4.5f}};
  const glm::vec3 towardsSun = glm::normalize(kTowardsSun);
  const glm::vec2 across(towardsSun.x, towardsSun.z);
  float light = 1.0f;
  for (const Blocker& blocker : kBlockers) {
    const glm::vec2 shadow = -across * (blocker.height / towardsSun.y);
    const float t = glm::clamp(glm::dot(point - blocker.at, shadow) / glm::dot(shadow, shadow), 0.0f, 1.0f);
    const float distance = glm::length(point - blocker.at - shadow * t);
    const float blur = 0.04f + 0.12f * t;
    light =
        std::min(light, glm::mix(0.42f, 1.0f, glm::smoothstep(blocker.radius - blur, blocker.radius + blur, distance)));
    light *= glm::mix(0.6f, 1.0f,
                      glm::smoothstep(0.8f * blocker.radius, 1.5f * blocker.radius, glm::length(point - blocker.at)));
  }
  return light * glm::mix(0.55f, 1.0f, glm::smoothstep(0.0f, 0.35f, kRoadHalfWidth - std::abs(point.x)));
}

void addGround(Glb& glb, const StreetMaterials& materials) {
  Random random(99);
  const int stone = addSurface(glb, "cobbles", graniteRelief(12));
  const int across = static_cast<int>(2.0f * kRoadHalfWidth);
  for (int row = 0; row < kCobbledLength; ++row) {
    Mesh cobbles;
    for (int column = 0; column < across; ++column) {
      const glm::vec2 corner(static_cast<float>(column) - kRoadHalfWidth, 1.0f - static_cast<float>(row));
      append(cobbles, makeCobblePatch(corner, lightOnGround, random));
    }
    glb.add("cobbles", cobbles, stone, kTinted);
  }
  const float end = 1.0f - static_cast<float>(kCobbledLength);
  const float farHalf = (end + kLength) * 0.5f;
  const int farCobbles = addSurface(glb, "far cobbles", cobbleRelief(13));
  glb.add("far cobbles",
          makeRectangle({0, 0, end - farHalf}, {kRoadHalfWidth, 0, 0}, {0, 0, -farHalf},
                        {2.0f * kRoadHalfWidth, 2.0f * farHalf}),
          farCobbles, kTextured);
  const int soil = glb.addMaterial({.name = "joints", .baseColor = {0.05f, 0.045f, 0.04f, 1}, .unlit = false});
  glb.add("joints", makeRectangle({0, -0.008f, -6.0f}, {kRoadHalfWidth, 0, 0}, {0, 0, -7.1f}), soil, {.normals = true});
  Mesh pavement;
  for (const float side : {-1.0f, 1.0f}) {
    for (int i = 0; i < 50; ++i) {
      const float z = 3.0f - static_cast<float>(i);
      const float inner = side * (kRoadHalfWidth + 0.16f), outer = side * (kHalfWidth + 0.3f);
      append(pavement, boxBetween({std::min(side * kRoadHalfWidth, inner), -0.1f, z - 0.99f},
                                  {std::max(side * kRoadHalfWidth, inner), 0.13f, z}));
      append(pavement, boxBetween({std::min(inner, outer), -0.1f, z - 0.985f}, {std::max(inner, outer), 0.12f, z}));
    }
  }
  mapPlanar(pavement, 0.5f);
  glb.add("pavement", pavement, materials.granite, kTextured);
}

void addLamps(Glb& glb, const StreetMaterials& materials) {
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

void addTrees(Glb& glb, const StreetMaterials& materials) {
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

/// What is in focus: the board, a crate with a lantern, a pot with a bush.
void addSubject(Glb& glb, const StreetMaterials& materials) {
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

/// What is close to the lens: a railing at the right, a branch in autumn at the upper left.
void addNear(Glb& glb, const StreetMaterials& materials) {
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
  addHouses(glb, materials);
  addGround(glb, materials);
  addLamps(glb, materials);
  addShops(glb, materials);
  addTrees(glb, materials);
  addSubject(glb, materials);
  addNear(glb, materials);
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
