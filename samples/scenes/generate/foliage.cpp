// Alpha-masked leaf quads on thin stems: sprigs close to the lens, a shrub in focus, a hedge far away, and a
// bright sky between the leaves. Every leaf is two triangles; its outline is in the texture's alpha.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "generate/random.h"
#include "generate/scene.h"

namespace scenes {
namespace {

Canvas paintLeaf() {
  Canvas canvas(96, 192);
  canvas.paint([](glm::vec2 uv) {
    const float x = std::abs(uv.x - 0.5f) * 2.0f;
    const float y = 1.0f - uv.y;  // 0 at the stalk, 1 at the tip
    const float blade = std::clamp((y - 0.08f) / 0.9f, 0.0f, 1.0f);
    const float serration = 0.035f * std::abs(std::fmod(blade * 13.0f, 1.0f) - 0.5f);
    const float halfWidth = 0.98f * std::pow(std::sin(glm::pi<float>() * std::pow(blade, 0.72f)), 0.8f) - serration;
    const float stalk = y < 0.5f ? 0.035f : 0.0f;
    const float inside = std::max(halfWidth, stalk) - x;
    const float rib = std::abs(std::fmod(blade * 7.0f + x * 1.8f + 8.0f - 2.0f * x, 1.0f) - 0.5f);
    const bool vein = x < 0.045f * (1.2f - y) || rib < 0.06f;
    const float grain = tilingNoise(uv * glm::vec2(12, 24), 64, 5u);
    const glm::vec3 green = glm::mix(glm::vec3(0.52f, 0.68f, 0.22f), glm::vec3(0.62f, 0.78f, 0.30f), grain);
    const glm::vec3 color = vein ? glm::vec3(0.78f, 0.86f, 0.50f) : green;
    // Beyond the outline the colour goes on, so that filtering mixes no foreign colour in.
    return glm::vec4(color, std::clamp(0.5f + inside * 24.0f, 0.0f, 1.0f));
  });
  return canvas;
}

struct Sprig {
  glm::vec3 start;
  glm::vec3 direction;
  float length;    ///< m
  float leafSize;  ///< m
  int leaves;
  glm::vec3 tint;
};

void addLeaf(Mesh& leaves, Random& random, glm::vec3 at, glm::vec3 along, float size, glm::vec3 tint) {
  const glm::vec3 facing = glm::normalize(glm::vec3(0.0f, 0.45f, 0.8f) + random.cube() * 0.65f);
  const glm::vec3 up = glm::normalize(along - facing * glm::dot(along, facing));
  const glm::vec3 right = glm::cross(up, facing);
  const float height = size * random.between(0.8f, 1.2f);
  const glm::vec3 center = at + up * (height * 0.5f);
  const float tone = random.between(0.75f, 1.25f);
  const glm::vec3 color = tint * tone * glm::vec3(random.between(0.85f, 1.2f), 1.0f, random.between(0.7f, 1.0f));
  append(leaves, colored(makeRectangle(center, right * (height * 0.25f), up * (height * 0.5f)),
                         glm::vec4(glm::clamp(color, 0.0f, 1.0f), 1.0f)));
}

void addSprig(Mesh& leaves, Mesh& stems, Random& random, const Sprig& sprig) {
  constexpr int kSegments = 6;
  std::vector<TubePoint> path;
  glm::vec3 direction = glm::normalize(sprig.direction);
  glm::vec3 position = sprig.start;
  const float thickness = sprig.leafSize * 0.045f;
  for (int i = 0; i <= kSegments; ++i) {
    path.push_back({position, thickness * (1.0f - 0.8f * static_cast<float>(i) / kSegments)});
    direction = glm::normalize(direction + random.cube() * 0.16f);
    position += direction * (sprig.length / kSegments);
  }
  append(stems, colored(makeTube(path, 5), {0.30f, 0.26f, 0.12f, 1}));
  for (int i = 0; i < sprig.leaves; ++i) {
    const float t = (static_cast<float>(i) + 0.8f) / static_cast<float>(sprig.leaves) * kSegments;
    const auto segment = static_cast<size_t>(std::min(static_cast<int>(t), kSegments - 1));
    const glm::vec3 at = glm::mix(path[segment].position, path[segment + 1].position, t - static_cast<float>(segment));
    const glm::vec3 along = glm::normalize(path[segment + 1].position - path[segment].position);
    const glm::vec3 side = glm::normalize(glm::cross(along, glm::vec3(0.2f, 0.1f, 1.0f)));
    const glm::vec3 outward = along * 0.5f + side * (i % 2 == 0 ? 1.0f : -1.0f) + random.cube() * 0.3f;
    addLeaf(leaves, random, at, outward, sprig.leafSize, sprig.tint);
  }
  addLeaf(leaves, random, path.back().position, direction, sprig.leafSize, sprig.tint);
}

void addNear(Mesh& leaves, Mesh& stems, Random& random) {
  const glm::vec3 tint(0.55f, 0.75f, 0.35f);
  addSprig(leaves, stems, random, {{-0.62f, 0.36f, -1.00f}, {0.9f, -0.35f, 0.10f}, 0.55f, 0.15f, 9, tint});
  addSprig(leaves, stems, random, {{-0.70f, -0.05f, -1.25f}, {0.8f, -0.55f, 0.05f}, 0.45f, 0.16f, 7, tint});
  addSprig(leaves, stems, random, {{0.66f, -0.40f, -0.98f}, {-0.5f, 0.75f, 0.05f}, 0.42f, 0.14f, 8, tint});
  addSprig(leaves, stems, random,
           {{0.62f, 0.44f, -1.15f}, {-0.8f, -0.25f, 0.0f}, 0.36f, 0.13f, 7, {0.9f, 0.6f, 0.25f}});
}

void addShrub(Mesh& leaves, Mesh& stems, Random& random) {
  for (int i = 0; i < 15; ++i) {
    const float spread = static_cast<float>(i) / 14.0f * 2.0f - 1.0f;
    const glm::vec3 start(0.08f + spread * 0.28f, -0.95f, -2.5f + random.between(-0.16f, 0.16f));
    const glm::vec3 direction(spread * 0.75f + random.between(-0.15f, 0.15f), 1.0f, random.between(-0.22f, 0.22f));
    const glm::vec3 tint = i % 4 == 1 ? glm::vec3(0.95f, 0.42f, 0.22f) : glm::vec3(0.8f, 1.0f, 0.75f);
    addSprig(leaves, stems, random, {start, direction, random.between(1.15f, 1.75f), 0.16f, 18, tint});
  }
}

void addHedge(Mesh& leaves, Mesh& stems, Random& random) {
  for (int i = 0; i < 30; ++i) {
    const float x = -4.2f + 8.4f * (static_cast<float>(i) + random.unit()) / 30.0f;
    const glm::vec3 start(x, -1.7f, random.between(-8.5f, -5.2f));
    const glm::vec3 direction(random.between(-0.3f, 0.3f), 1.0f, 0.0f);
    const float length = random.between(1.9f, 3.4f);
    addSprig(leaves, stems, random, {start, direction, length, 0.36f, 15, {0.5f, 0.8f, 0.55f}});
  }
}

}  // namespace

Scene makeFoliage() {
  Scene scene;
  Random random(440);
  const int leafTexture = scene.glb.addTexture("leaf", paintLeaf(), Wrap::clamp, true);
  const int leaf = scene.glb.addMaterial(
      {.name = "leaf", .texture = leafTexture, .alphaMode = AlphaMode::mask, .alphaCutoff = 0.5f, .doubleSided = true});
  const int stem = scene.glb.addMaterial({.name = "stem"});
  Mesh stems;
  const BakedLight sunThroughLeaves{.sun = {0.95f, 0.92f, 0.7f}, .twoSided = true};
  const std::array<const char*, 3> names = {"near leaves", "shrub leaves", "hedge leaves"};
  const std::array<void (*)(Mesh&, Mesh&, Random&), 3> makers = {addNear, addShrub, addHedge};
  for (size_t i = 0; i < makers.size(); ++i) {
    Mesh leaves;
    makers[i](leaves, stems, random);
    bakeLight(leaves, sunThroughLeaves);
    scene.glb.add(names[i], leaves, leaf, {.uvs = true, .colors = true});
  }
  Mesh ground = makeRectangle({0, -1.7f, -10.0f}, {12, 0, 0}, {0, 0, -9.0f});
  append(stems, colored(ground, {0.22f, 0.33f, 0.10f, 1}));
  bakeLight(stems);
  scene.glb.add("stems and ground", stems, stem, {.colors = true});

  Shot shot;
  shot.name = "foliage";
  shot.description = "alpha-masked leaves at 0.9-1.3 m, 2.5 m (focus) and 5-8.5 m before a bright sky";
  shot.camera = {.position = {0, 0, 0}, .target = {0, -0.02f, -1}, .fovyDeg = 40.0f};
  shot.lens = {.apertureRadius = 0.04, .focusDistance = 2.5};
  shot.background = {0.62, 0.8, 1.0};
  scene.shots.push_back(shot);
  return scene;
}

}  // namespace scenes
