// A wood in the morning: several hundred plants of a few kinds, each placed many times. In focus at 3.5 m is a stump with
// mushrooms; fern and branch are close to the lens. Haze is in the materials: what is far is paler and glows a little.
#include "heavy/forest.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "heavy/heavy_scenes.h"
#include "parts/plants.h"
#include "parts/shapes.h"
#include "parts/surface_maps.h"
#include "parts/surfaces.h"

namespace scenes {
namespace {

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
      // x and z from the stump's middle, height of the foot, height of the mushroom; all in meters.
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

float groundAt(float x, float z) {
  const float waves = tilingClouds(glm::vec2(x, z) * 0.11f + 40.0f, 128, 7, 4) - 0.5f;
  const float away = glm::smoothstep(2.0f, 12.0f, glm::length(glm::vec2(x, z + 2.0f)));
  return 2.2f * waves * away + 0.03f * std::max(0.0f, -z - 8.0f);
}

float sunAt(float x, float z) {
  const float patches = tilingClouds(glm::vec2(x, z) * 0.55f + 90.0f, 256, 23, 3);
  const float focus = std::exp(-glm::dot(glm::vec2(x, z) - kStump, glm::vec2(x, z) - kStump) * 0.5f);
  return std::max(glm::smoothstep(0.47f, 0.58f, patches), focus);
}

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
  addForestTrees(glb, materials);
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
