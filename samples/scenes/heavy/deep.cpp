// Curtains of beads, lattices, grilles and blinds, one behind another from 0.33 to 50 m: about ten surfaces behind every
// pixel. A round hole in the layers leads the eye to lanterns, of which the nearest is in focus.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <string>
#include <vector>

#include "heavy/heavy_scenes.h"
#include "parts/furniture.h"
#include "parts/lattices.h"
#include "parts/shapes.h"
#include "parts/surface_maps.h"
#include "parts/surfaces.h"

namespace scenes {
namespace {

constexpr float kFovyDeg = 36.0f;
constexpr float kAspect = 16.0f / 9.0f;
constexpr float kLensRadius = 0.025f;  // m
constexpr int kLayers = 36;
constexpr float kNearest = 0.33f;   // m
constexpr float kFarthest = 50.0f;  // m
constexpr float kFocus = 1.25f;     // m

enum class Pattern { beads, diagonal, rings, grille, blind };

/// Depth of a layer: the same ratio from each to the next.
float depthOf(int layer) {
  return kNearest * std::pow(kFarthest / kNearest, static_cast<float>(layer) / (kLayers - 1));
}

/// The part of the plane that any point of the lens sees, the hole, and cells whose size in the picture shrinks slowly.
LatticeArea areaAt(int layer) {
  const float depth = depthOf(layer);
  const float tangent = std::tan(glm::radians(kFovyDeg) * 0.5f);
  const float halfHeight = tangent * depth * 1.02f + kLensRadius;
  // The hole wanders a little. It is wider in what is close, so that the lens looks through onto what is in focus.
  const float angle = 0.35f * static_cast<float>(layer);
  const float share = depth < 0.85f * kFocus ? 0.86f : glm::mix(0.46f, 0.30f, glm::smoothstep(1.0f, 8.0f, depth));
  return {.halfSize = {tangent * kAspect * depth * 1.02f + kLensRadius, halfHeight},
          .holeCenter = glm::vec2(0.26f * std::cos(angle) * 0.12f, 0.05f + 0.03f * std::sin(angle)) * tangent * depth,
          .holeRadius = share * tangent * depth,
          .pitch = 0.088f * std::pow(depth, 0.86f)};
}

struct Layer {
  Pattern pattern;
  float coverage;
  int material;
};

Mesh meshOf(const Layer& layer, const LatticeArea& area, Random& random) {
  switch (layer.pattern) {
    case Pattern::beads:
      return makeBeadCurtain(area, layer.coverage, random);
    case Pattern::diagonal:
      return makeDiagonalLattice(area, layer.coverage);
    case Pattern::rings:
      return makeRingScreen(area, layer.coverage);
    case Pattern::grille:
      return makeTurnedGrille(area, layer.coverage);
    case Pattern::blind:
      return makeBlind(area, layer.coverage);
  }
  return {};
}

std::vector<Layer> chooseLayers(Glb& glb) {
  const int walnut = addSurface(glb, "walnut", boardRelief({0.40f, 0.26f, 0.16f}, 1));
  const int oak = addSurface(glb, "oak", boardRelief({0.68f, 0.52f, 0.34f}, 2));
  const int teal = addSurface(glb, "teal paint", boardRelief({0.16f, 0.42f, 0.42f}, 3));
  const int brass = addSurface(glb, "brass", brassRelief(4));
  const int iron = addSurface(glb, "iron", ironRelief({0.14f, 0.13f, 0.15f}, 5));
  const int ivory = addSurface(glb, "ivory", plasterRelief({0.90f, 0.84f, 0.72f}, 6));
  const auto glazed = [&glb](const char* name, glm::vec3 color) {
    return glb.addMaterial({.name = name, .baseColor = glm::vec4(color, 1), .unlit = false, .roughness = 0.34f});
  };
  const int ruby = glazed("ruby beads", {0.42f, 0.03f, 0.05f});
  const int jade = glazed("jade beads", {0.06f, 0.30f, 0.20f});
  const int amber = glazed("amber beads", {0.62f, 0.28f, 0.03f});
  const int azure = glazed("azure beads", {0.04f, 0.16f, 0.42f});
  const std::array<Layer, 12> order = {
      Layer{Pattern::grille, 0.40f, walnut}, {Pattern::beads, 0.52f, ruby},  {Pattern::diagonal, 0.34f, oak},
      {Pattern::rings, 0.42f, brass},        {Pattern::beads, 0.50f, azure}, {Pattern::blind, 0.46f, ivory},
      {Pattern::diagonal, 0.36f, teal},      {Pattern::beads, 0.52f, amber}, {Pattern::rings, 0.42f, iron},
      {Pattern::grille, 0.42f, ivory},       {Pattern::beads, 0.50f, jade},  {Pattern::blind, 0.44f, walnut}};
  std::vector<Layer> layers;
  for (int i = 0; i < kLayers; ++i) layers.push_back(order[static_cast<size_t>(i) % order.size()]);
  // Thin ones close to the lens, so that something is left to be seen.
  const std::array<Layer, 4> thin = {Layer{Pattern::rings, 0.12f, ivory},
                                     {Pattern::beads, 0.13f, ruby},
                                     {Pattern::diagonal, 0.07f, teal},
                                     {Pattern::beads, 0.14f, amber}};
  for (size_t i = 0; i < layers.size() && depthOf(static_cast<int>(i)) < kFocus * 0.85f; ++i)
    layers[i] = thin[i % thin.size()];
  return layers;
}

void addLanterns(Glb& glb) {
  const int brass = addSurface(glb, "lantern brass", brassRelief(14));
  const StreetLamp lantern = makeTableLantern();
  const int metal = glb.addMesh("lantern", lantern.metal, brass, kTextured);
  const int glow = glb.addMaterial({.name = "flame",
                                    .baseColor = {0, 0, 0, 1},
                                    .unlit = false,
                                    .emissive = {1.0f, 0.66f, 0.32f},
                                    .emissiveStrength = 14.0f});
  const int flame = glb.addMesh("flame", lantern.globe, glow, {.normals = true});
  Mesh cords;
  // x and y as shares of the view's half height, depth in meters, size.
  for (const glm::vec4 place : {glm::vec4(-0.04f, -0.17f, 1.25f, 0.5f),
                                {0.17f, 0.02f, 2.7f, 0.7f},
                                {-0.2f, 0.12f, 4.6f, 0.9f},
                                {0.12f, 0.18f, 8.0f, 1.3f},
                                {-0.10f, -0.20f, 13.0f, 1.8f},
                                {0.2f, -0.14f, 20.0f, 2.4f},
                                {0.0f, 0.20f, 32.0f, 3.2f}}) {
    const float half = std::tan(glm::radians(kFovyDeg) * 0.5f) * place.z;
    const glm::vec3 at(place.x * half, place.y * half, -place.z);
    glb.addNode("lantern", metal, {.translation = at, .scale = place.w});
    glb.addNode("flame", flame, {.translation = at, .scale = place.w});
    const std::array<TubePoint, 2> cord = {
        TubePoint{at + glm::vec3(0, 0.43f * place.w, 0), 0.004f * place.w},
        TubePoint{at + glm::vec3(0, 0.5f * half + 0.6f * place.w, 0), 0.004f * place.w}};
    append(cords, makeTube(cord, 6));
    if (place.z < 15.0f) {
      glb.addLight(
          {.name = "lantern", .type = "point", .color = {1.0f, 0.66f, 0.34f}, .intensity = 0.10f * place.z * place.z},
          at + lantern.light * place.w, at);
    }
  }
  glb.add("cords", cords, brass, kTextured);
}

}  // namespace

HeavyScene makeDeep() {
  HeavyScene heavy;
  heavy.name = "deep";
  heavy.sky = {.zenith = {0.20f, 0.28f, 0.44f},
               .horizon = {0.72f, 0.60f, 0.50f},
               .ground = {0.20f, 0.15f, 0.12f},
               .towardsSun = {-0.6f, 0.5f, 0.6f},
               .glow = {1.2f, 0.9f, 0.6f}};
  Glb& glb = heavy.scene.glb;
  Random random(36);
  const std::vector<Layer> layers = chooseLayers(glb);
  for (int i = 0; i < kLayers; ++i) {
    const LatticeArea area = areaAt(i);
    const Layer& layer = layers[static_cast<size_t>(i)];
    const std::string name = "layer " + std::to_string(i);
    Mesh mesh = meshOf(layer, area, random);
    if (layer.pattern != Pattern::beads) append(mesh, makeHoleFrame(area, 0.10f * area.pitch));
    // What is close stands in the shade, and the light grows with the distance.
    shade(mesh, glm::mix(0.6f, 1.0f, glm::smoothstep(0.3f, 3.0f, depthOf(i))));
    glb.addNode(name, glb.addMesh(name, mesh, layer.material, kTinted), {.translation = {0, 0, -depthOf(i)}});
  }
  addLanterns(glb);
  addSkyDome(glb, heavy.sky, 120.0f);
  glb.addLight({.name = "sun", .type = "directional", .color = {1.0f, 0.86f, 0.68f}, .intensity = 1.5f},
               {-0.6f, 0.5f, 0.7f}, glm::vec3(0.0f));

  Shot shot;
  shot.name = heavy.name;
  shot.description =
      "36 curtains, lattices and blinds from 0.33 to 50 m behind each other, a lantern in focus at 1.2 m";
  shot.camera = {.position = {0, 0, 0}, .target = {0, 0, -1.0f}, .fovyDeg = kFovyDeg};
  shot.lens = {.apertureRadius = static_cast<double>(kLensRadius), .focusDistance = static_cast<double>(kFocus)};
  shot.background = {0.4, 0.35, 0.3};
  shot.lit = true;
  shot.environment = heavy.name + "_sky.exr";
  heavy.scene.shots.push_back(shot);
  return heavy;
}

}  // namespace scenes
