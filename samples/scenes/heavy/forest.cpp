// A wood in the morning: several hundred plants of a few kinds, each placed many times. In focus at 3.5 m is a stump with
// mushrooms; fern and branch are close to the lens. Haze is in the materials: what is far is paler and glows a little.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <string>
#include <vector>

#include "heavy/heavy_scenes.h"
#include "heavy/plants.h"
#include "heavy/shapes.h"
#include "heavy/surfaces.h"

namespace scenes {
namespace {

constexpr Attributes kTextured{.normals = true, .uvs = true};
constexpr Attributes kTinted{.normals = true, .uvs = true, .colors = true};
constexpr Attributes kColored{.normals = true, .colors = true};
const glm::vec2 kStump(-0.12f, -3.5f);

/// Height of the ground in metres: hollows and knolls, flat where the camera and the stump stand.
float groundAt(float x, float z) {
  const float waves = tilingClouds(glm::vec2(x, z) * 0.11f + 40.0f, 128, 7, 4) - 0.5f;
  const float away = glm::smoothstep(2.0f, 12.0f, glm::length(glm::vec2(x, z + 2.0f)));
  return 2.2f * waves * away + 0.03f * std::max(0.0f, -z - 8.0f);
}

/// 1 where sun falls through the crowns, 0 in shade.
float sunAt(float x, float z) {
  const float patches = tilingClouds(glm::vec2(x, z) * 0.55f + 90.0f, 256, 23, 3);
  const float focus = std::exp(-glm::dot(glm::vec2(x, z) - kStump, glm::vec2(x, z) - kStump) * 0.5f);
  return std::max(glm::smoothstep(0.47f, 0.58f, patches), focus);
}

constexpr int kBands = 3;

/// Materials of one distance.
struct Band {
  int leaf, bark, fern;
};

struct ForestMaterials {
  std::array<Band, kBands> bands;
  int floor, litter;
};

/// share: of the plant's own light that the haze lets through.
Material hazed(Material material, float share) {
  material.baseColor = glm::vec4(glm::vec3(material.baseColor) * share, material.baseColor.a);
  if (share < 1.0f) material.emissive = glm::vec3(0.40f, 0.46f, 0.36f) * (1.0f - share);
  return material;
}

ForestMaterials addMaterials(Glb& glb) {
  ForestMaterials m{};
  const int leaf = glb.addTexture("leaf", paintLeafTexture(), Wrap::clamp, true);
  const SurfaceMaps bark = mapsOf(barkRelief(41));
  const int barkColor = glb.addTexture("bark", bark.color, Wrap::repeat);
  const int barkNormal = glb.addTexture("bark normals", bark.normal, Wrap::repeat);
  const int barkRoughness = glb.addTexture("bark roughness", bark.metallicRoughness, Wrap::repeat);
  const std::array<float, kBands> shares = {1.0f, 0.86f, 0.6f};
  for (size_t i = 0; i < kBands; ++i) {
    const std::string suffix = " " + std::to_string(i);
    m.bands[i].leaf = glb.addMaterial(hazed({.name = "leaf" + suffix,
                                             .texture = leaf,
                                             .alphaMode = AlphaMode::mask,
                                             .doubleSided = true,
                                             .unlit = false,
                                             .roughness = 0.55f},
                                            shares[i]));
    m.bands[i].bark = glb.addMaterial(hazed({.name = "bark" + suffix,
                                             .texture = barkColor,
                                             .unlit = false,
                                             .metallic = 1.0f,
                                             .normalTexture = barkNormal,
                                             .metallicRoughnessTexture = barkRoughness},
                                            shares[i]));
    m.bands[i].fern = glb.addMaterial(
        hazed({.name = "fern" + suffix, .doubleSided = true, .unlit = false, .roughness = 0.6f}, shares[i]));
  }
  m.floor = addSurface(glb, "forest floor", forestFloorRelief(3));
  m.litter = glb.addMaterial({.name = "litter",
                              .texture = leaf,
                              .alphaMode = AlphaMode::mask,
                              .doubleSided = true,
                              .unlit = false,
                              .roughness = 0.8f});
  return m;
}

size_t bandOf(float distance) {
  return distance < 9.0f ? 0 : distance < 20.0f ? 1 : 2;
}

glm::quat turned(float yaw) {
  return glm::angleAxis(yaw, glm::vec3(0, 1, 0));
}

void addGround(Glb& glb, const ForestMaterials& materials) {
  Mesh ground = makeRectangle({0, 0, -29.0f}, {34, 0, 0}, {0, 0, -32.0f}, glm::vec2(1.0f), {190, 180});
  for (Vertex& vertex : ground.vertices) {
    glm::vec3& p = vertex.position;
    p.y = groundAt(p.x, p.z);
    vertex.uv = glm::vec2(p.x, p.z) * 0.5f;
    const float light = glm::mix(0.34f, 1.0f, sunAt(p.x, p.z));
    vertex.color = glm::vec4(glm::vec3(light), 1.0f);
  }
  smoothNormals(ground);
  glb.add("ground", ground, materials.floor, kTinted);
}

/// One mesh for each band, of the same geometry.
struct Banded {
  std::array<int, kBands> mesh;
};

Banded addBanded(Glb& glb, const std::string& name, const Mesh& mesh, const ForestMaterials& materials,
                 int Band::*material, Attributes attributes) {
  Banded banded{};
  for (size_t i = 0; i < kBands; ++i) {
    banded.mesh[i] = glb.addMesh(name, mesh, materials.bands[i].*material, attributes);
  }
  return banded;
}

void addTrees(Glb& glb, const ForestMaterials& materials) {
  Random random(2024);
  const std::array<TreeShape, 4> shapes = {TreeShape{.height = 9.5f,
                                                     .trunkRadius = 0.17f,
                                                     .bareShare = 0.20f,
                                                     .branches = 17,
                                                     .leaves = 13,
                                                     .leafSize = 0.18f,
                                                     .spread = 0.34f,
                                                     .leafTint = {0.46f, 0.66f, 0.22f}},
                                           TreeShape{.height = 11.0f,
                                                     .trunkRadius = 0.24f,
                                                     .bareShare = 0.26f,
                                                     .branches = 18,
                                                     .leaves = 13,
                                                     .leafSize = 0.18f,
                                                     .spread = 0.32f,
                                                     .leafTint = {0.36f, 0.56f, 0.18f}},
                                           TreeShape{.height = 8.0f,
                                                     .trunkRadius = 0.12f,
                                                     .bareShare = 0.18f,
                                                     .branches = 16,
                                                     .leaves = 13,
                                                     .leafSize = 0.18f,
                                                     .spread = 0.36f,
                                                     .leafTint = {0.62f, 0.70f, 0.24f}},
                                           TreeShape{.height = 3.2f,
                                                     .trunkRadius = 0.035f,
                                                     .bareShare = 0.1f,
                                                     .branches = 13,
                                                     .twigs = 7,
                                                     .leaves = 9,
                                                     .leafSize = 0.10f,
                                                     .spread = 0.42f,
                                                     .leafTint = {0.50f, 0.72f, 0.26f}}};
  std::vector<Banded> woods, crowns;
  for (const TreeShape& shape : shapes) {
    const Plant tree = makeTree(shape, random);
    woods.push_back(addBanded(glb, "tree", tree.wood, materials, &Band::bark, kTextured));
    crowns.push_back(addBanded(glb, "crown", tree.leaves, materials, &Band::leaf, kTinted));
  }
  std::vector<glm::vec2> taken;
  while (taken.size() < 86) {
    const float z = random.between(-44.0f, -4.2f);
    const float x = random.between(-1.0f, 1.0f) * (3.0f - 0.72f * z);
    // A glade around the stump, and a way that leads away from it.
    const float way = 0.9f * std::sin(z * 0.22f);
    if (glm::length(glm::vec2(x, z) - kStump) < 2.6f || (std::abs(x - way) < 1.3f - 0.02f * z && z > -26.0f)) continue;
    const auto tooClose = [&](glm::vec2 other) { return glm::length(other - glm::vec2(x, z)) < 1.7f; };
    if (std::ranges::any_of(taken, tooClose)) continue;
    taken.emplace_back(x, z);
    const size_t kind = z > -6.5f ? 3 : random.next() % shapes.size();
    const Placement at{.translation = {x, groundAt(x, z), z},
                       .rotation = turned(random.between(0.0f, 6.28f)),
                       .scale = random.between(0.8f, 1.2f)};
    const size_t band = bandOf(-z);
    glb.addNode("tree", woods[kind].mesh[band], at);
    glb.addNode("crown", crowns[kind].mesh[band], at);
  }
}

Mesh makeLitter(Random& random) {
  Mesh litter;
  for (int i = 0; i < 34; ++i) {
    const float size = random.between(0.05f, 0.10f);
    Mesh leaf = makeFoldedLeaf(size, size * 0.6f, random.between(0.0f, 0.18f), random.between(-0.1f, 0.25f));
    leaf = colored(
        leaf, glm::vec4(glm::mix(glm::vec3(0.62f, 0.34f, 0.10f), glm::vec3(0.40f, 0.26f, 0.12f), random.unit()), 1));
    const glm::vec3 at(random.between(-0.5f, 0.5f), random.between(0.012f, 0.04f), random.between(-0.5f, 0.5f));
    const glm::mat4 flat =
        glm::rotate(glm::translate(glm::mat4(1.0f), at), random.between(0.0f, 6.28f), glm::vec3(0, 1, 0)) *
        glm::rotate(glm::mat4(1.0f), -1.57f + random.between(-0.3f, 0.3f), glm::vec3(1, 0, 0));
    append(litter, transformed(leaf, flat));
  }
  return litter;
}

/// Ferns, grass and leaves on the ground; in the shade darker ones.
void addUndergrowth(Glb& glb, const ForestMaterials& materials) {
  Random random(77);
  std::vector<Banded> ferns, grasses, litters;
  for (int i = 0; i < 4; ++i) {
    const float light = i < 2 ? 1.0f : 0.42f;  // The latter two stand in the shade.
    Mesh fern = makeFern(0.66f, 10 + i % 2 * 2, 21, random);
    Mesh grass = makeGrass(0.34f, 70, random);
    shade(fern, light);
    shade(grass, light);
    ferns.push_back(addBanded(glb, "fern", fern, materials, &Band::fern, kColored));
    grasses.push_back(addBanded(glb, "grass", grass, materials, &Band::fern, kColored));
  }
  Mesh litter = makeLitter(random);
  const int sunny = glb.addMesh("litter", litter, materials.litter, kTinted);
  shade(litter, 0.4f);
  const int shady = glb.addMesh("litter", litter, materials.litter, kTinted);
  const auto scatter = [&](int count, float farthest, float power, const auto& place) {
    for (int i = 0; i < count; ++i) {
      const float z = -1.9f - (farthest - 1.9f) * std::pow(random.unit(), power);
      const float x = random.between(-1.0f, 1.0f) * (0.8f - 0.66f * z);
      const Placement at{.translation = {x, groundAt(x, z), z},
                         .rotation = turned(random.between(0.0f, 6.28f)),
                         .scale = random.between(0.7f, 1.3f)};
      place(at, sunAt(x, z) > 0.5f, bandOf(-z), random.next() % 2);
    }
  };
  scatter(170, 30.0f, 1.2f, [&](const Placement& at, bool inSun, size_t band, uint32_t kind) {
    const glm::vec2 fromStump = glm::vec2(at.translation.x, at.translation.z) - kStump;
    // The stump is to be seen.
    if (glm::length(fromStump) < 0.75f || (fromStump.y > 0.0f && std::abs(fromStump.x) < 0.7f)) return;
    glb.addNode("fern", ferns[kind + (inSun ? 0u : 2u)].mesh[band], at);
  });
  scatter(420, 22.0f, 1.6f, [&](const Placement& at, bool inSun, size_t band, uint32_t kind) {
    glb.addNode("grass", grasses[kind + (inSun ? 0u : 2u)].mesh[band], at);
  });
  scatter(150, 12.0f, 1.3f,
          [&](const Placement& at, bool inSun, size_t, uint32_t) { glb.addNode("litter", inSun ? sunny : shady, at); });
}

/// What is in focus: a mossy stump with mushrooms on it and around it.
void addSubject(Glb& glb, const ForestMaterials& materials) {
  const std::array<glm::vec2, 12> shape = {glm::vec2(0.0f, -0.1f), {0.42f, -0.1f},  {0.36f, 0.02f},  {0.29f, 0.10f},
                                           {0.25f, 0.20f},         {0.235f, 0.30f}, {0.23f, 0.38f},  {0.225f, 0.44f},
                                           {0.20f, 0.455f},        {0.14f, 0.45f},  {0.07f, 0.452f}, {0.0f, 0.45f}};
  Mesh stump = makeLathe(shape, 96);
  for (Vertex& vertex : stump.vertices) {
    const float angle = std::atan2(vertex.position.x, vertex.position.z);
    const float roots = std::max(0.0f, 0.25f - vertex.position.y);
    const float wave = 1.0f + 0.05f * std::sin(angle * 7.0f) + roots * (0.9f * std::sin(angle * 5.0f + 1.0f) + 0.3f);
    vertex.position *=
        glm::vec3(wave, 1.0f + 0.08f * std::sin(angle * 3.0f) * (vertex.position.y > 0.4f ? 1.0f : 0.0f), wave);
    vertex.uv = {vertex.uv.x * 3.0f,
                 vertex.position.y / 0.6f + glm::length(glm::vec2(vertex.position.x, vertex.position.z))};
  }
  smoothNormals(stump);
  glb.addNode("stump", glb.addMesh("stump", stump, materials.bands[0].bark, kTextured),
              {.translation = {kStump.x, 0, kStump.y}});
  Random random(8);
  const int skin = glb.addMaterial({.name = "mushroom", .unlit = false, .roughness = 0.38f});
  std::vector<int> mushrooms;
  for (int i = 0; i < 3; ++i) mushrooms.push_back(glb.addMesh("mushroom", makeMushroom(1.0f, random), skin, kColored));
  const std::array<glm::vec4, 13> places = {
      // x and z from the stump's middle, height of the foot, height of the mushroom; all in metres.
      glm::vec4(-0.05f, 0.05f, 0.45f, 0.21f),
      {0.09f, 0.02f, 0.45f, 0.15f},
      {-0.14f, -0.03f, 0.45f, 0.14f},
      {0.03f, 0.13f, 0.45f, 0.10f},
      {-0.12f, 0.12f, 0.44f, 0.09f},
      {0.14f, 0.11f, 0.44f, 0.08f},
      {0.46f, 0.22f, 0.0f, 0.17f},
      {0.56f, 0.30f, 0.0f, 0.12f},
      {0.52f, 0.12f, 0.0f, 0.11f},
      {-0.5f, 0.32f, 0.0f, 0.13f},
      {-0.58f, 0.22f, 0.0f, 0.19f},
      {0.38f, 0.4f, 0.0f, 0.08f},
      {-0.42f, 0.42f, 0.0f, 0.08f}};
  for (size_t i = 0; i < places.size(); ++i) {
    const glm::vec4 place = places[i];
    glb.addNode("mushroom", mushrooms[i % mushrooms.size()],
                {.translation = {kStump.x + place.x, place.z, kStump.y + place.y},
                 .rotation = turned(2.1f * static_cast<float>(i)),
                 .scale = place.w});
  }
}

/// What is close to the lens: a fern at the lower right, a branch at the upper left.
void addNear(Glb& glb, const ForestMaterials& materials) {
  Random random(15);
  glb.addNode("near fern", glb.addMesh("near fern", makeFern(0.62f, 11, 26, random), materials.bands[0].fern, kColored),
              {.translation = {0.68f, 0.22f, -1.42f}});
  const Plant branch = makeBranch(1.05f, 0.085f, 13, 7, {0.50f, 0.68f, 0.22f}, random);
  const Placement at{.translation = {-1.02f, 1.28f, -1.35f}, .rotation = turned(0.1f)};
  glb.addNode("near branch", glb.addMesh("near branch", branch.wood, materials.bands[0].bark, kTextured), at);
  glb.addNode("near leaves", glb.addMesh("near leaves", branch.leaves, materials.bands[0].leaf, kTinted), at);
}

}  // namespace

HeavyScene makeForest() {
  HeavyScene heavy;
  heavy.name = "forest";
  heavy.sky = {.zenith = {0.50f, 0.66f, 0.85f},
               .horizon = {0.80f, 0.84f, 0.68f},
               .ground = {0.10f, 0.10f, 0.05f},
               .towardsSun = {0.25f, 0.30f, -1.0f},
               .glow = {0.6f, 0.5f, 0.3f}};
  Glb& glb = heavy.scene.glb;
  const ForestMaterials materials = addMaterials(glb);
  addGround(glb, materials);
  addTrees(glb, materials);
  addUndergrowth(glb, materials);
  addSubject(glb, materials);
  addNear(glb, materials);
  addSkyDome(glb, heavy.sky, 120.0f);
  glb.addLight({.name = "sun", .type = "directional", .color = {1.0f, 0.90f, 0.70f}, .intensity = 2.6f},
               {0.75f, 0.8f, 0.35f}, glm::vec3(0.0f));

  Shot shot;
  shot.name = heavy.name;
  shot.description = "a wood in the morning: mushrooms in focus at 3.4 m, fern and branch close, trees far";
  shot.camera = {.position = {0.0f, 0.95f, 0.0f}, .target = {0.05f, 0.78f, -3.5f}, .fovyDeg = 36.0f};
  shot.lens = {.apertureRadius = 0.066, .focusDistance = 3.4};
  shot.background = {0.7, 0.75, 0.6};
  shot.lit = true;
  shot.environment = heavy.name + "_sky.exr";
  heavy.scene.shots.push_back(shot);
  return heavy;
}

}  // namespace scenes
