// Strong foreground blur over detail in focus (after Lee 2009, fig. 8, first row), at any number of
// triangles: carved stones on stalks close to the lens, a row of them in focus, more far away. The committed
// scene is its coarsest form; the scaling scenes differ from it in tessellation alone, so pictures and blur
// stay alike.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "generate/random.h"
#include "generate/scene.h"

namespace scenes {
namespace {

constexpr int kShapes = 6;

struct Stone {
  glm::vec3 center;
  float radius;  ///< m
};

std::vector<Stone> layOut() {
  std::vector<Stone> stones = {{{-0.33f, -0.14f, -0.92f}, 0.085f}, {{0.36f, 0.16f, -1.05f}, 0.095f},
                               {{-0.12f, 0.24f, -1.25f}, 0.07f},   {{0.30f, -0.20f, -0.85f}, 0.05f},
                               {{-0.52f, 0.20f, -1.15f}, 0.07f},   {{0.05f, -0.26f, -1.10f}, 0.05f}};
  for (int i = 0; i < 7; ++i) {  // in focus
    const float x = -1.05f + 0.35f * static_cast<float>(i);
    stones.push_back(
        {{x, 0.12f * std::sin(static_cast<float>(i) * 1.9f), -2.5f + 0.1f * static_cast<float>(i % 3 - 1)}, 0.15f});
  }
  for (int i = 0; i < 11; ++i) {  // far
    const float x = -3.1f + 0.62f * static_cast<float>(i);
    stones.push_back(
        {{x, -0.3f + 0.55f * static_cast<float>((i * 5) % 4) * 0.5f, -5.2f - 0.5f * static_cast<float>(i % 3)}, 0.3f});
  }
  return stones;
}

/// A unit sphere carved by waves, its hollows darker, its colour banded: form and texture in vertices alone.
Mesh carve(int rings, int shape) {
  Mesh mesh = makeSphere(rings, 2 * rings);
  Random random(static_cast<uint64_t>(shape) + 300u);
  const float lobes = 3.0f + static_cast<float>(shape % 4);
  const float bands = 5.0f + static_cast<float>((shape * 3) % 5);
  const glm::vec3 phase = random.cube() * 3.0f;
  const float hue = static_cast<float>(shape) * 1.05f;
  const glm::vec3 base = 0.55f + 0.35f * glm::cos(glm::vec3(hue, hue - 2.094f, hue + 2.094f));
  const auto height = [&](glm::vec3 p) {
    const float around = std::atan2(p.x, p.z);
    const float poles = 1.0f - p.y * p.y;  // Waves fade towards the poles, where they would pinch.
    return 1.0f + poles * (0.10f * std::cos(lobes * around + phase.x + 2.0f * p.y) +
                           0.06f * std::cos(bands * 2.0f * p.y + phase.y));
  };
  for (Vertex& vertex : mesh.vertices) {
    const glm::vec3 p = vertex.position;
    const float h = height(p);
    const glm::vec3 helper = std::abs(p.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    const glm::vec3 u = glm::normalize(glm::cross(helper, p));
    const glm::vec3 v = glm::cross(p, u);
    constexpr float kStep = 1e-3f;
    const glm::vec3 pu = glm::normalize(p + u * kStep);
    const glm::vec3 pv = glm::normalize(p + v * kStep);
    vertex.normal = glm::normalize(glm::cross(pu * height(pu) - p * h, pv * height(pv) - p * h));
    vertex.position = p * h;
    const float band =
        glm::smoothstep(-0.3f, 0.3f, std::sin(p.y * 14.0f + 1.5f * std::sin(lobes * std::atan2(p.x, p.z))));
    const glm::vec3 color =
        glm::mix(base, glm::vec3(0.92f, 0.88f, 0.78f), band) * glm::clamp(h * 3.0f - 2.3f, 0.35f, 1.0f);
    vertex.color = glm::vec4(color, 1.0f);
  }
  bakeLight(mesh, {.sun = {0.8f, 0.75f, 0.62f}});
  return mesh;
}

Canvas paintMural() {
  Canvas canvas(512, 288);
  canvas.paint([](glm::vec2 uv) {
    const glm::vec2 cell = uv * glm::vec2(16, 9);
    const glm::vec2 inCell = cell - glm::floor(cell) - 0.5f;
    const float kind = tilingNoise(glm::floor(cell) + 0.0f, 64, 31);
    const float ring = std::abs(glm::length(inCell) - 0.3f);
    const bool inked = kind > 0.5f ? ring < 0.07f : std::min(std::abs(inCell.x), std::abs(inCell.y)) < 0.06f;
    const glm::vec3 ground = glm::mix(glm::vec3(0.24f, 0.33f, 0.45f), glm::vec3(0.72f, 0.62f, 0.45f), uv.y);
    return glm::vec4(inked ? glm::vec3(0.95f, 0.92f, 0.85f) : ground, 1.0f);
  });
  return canvas;
}

}  // namespace

Scene makeForegroundBlur(size_t triangles, const std::string& name) {
  Scene scene;
  const std::vector<Stone> stones = layOut();
  int rings = 8;
  const auto drawn = [&stones](int count) {
    return stones.size() * 4 * static_cast<size_t>(count) * static_cast<size_t>(count - 1);
  };
  while (drawn(rings) < triangles) ++rings;
  const int stone = scene.glb.addMaterial({.name = "stone"});
  std::array<int, kShapes> meshes{};
  for (int shape = 0; shape < kShapes; ++shape) {
    meshes[static_cast<size_t>(shape)] =
        scene.glb.addMesh("stone " + std::to_string(shape), carve(rings, shape), stone, {.colors = true});
  }
  Mesh stalks;
  for (size_t i = 0; i < stones.size(); ++i) {
    const glm::quat tilt = glm::angleAxis(0.5f * std::sin(static_cast<float>(i) * 2.3f), glm::vec3(0, 0, 1));
    scene.glb.addNode("stone", meshes[i % kShapes],
                      {.translation = stones[i].center, .rotation = tilt, .scale = stones[i].radius});
    const glm::vec3 top = stones[i].center;
    const float width = stones[i].radius * 0.08f;
    const std::array<TubePoint, 2> stalk = {TubePoint{{top.x, -1.3f, top.z}, width}, TubePoint{top, width}};
    append(stalks, makeTube(stalk, 10));
  }
  stalks = colored(stalks, {0.16f, 0.14f, 0.12f, 1});
  bakeLight(stalks);
  scene.glb.add("stalks", stalks, stone, {.colors = true});
  const int mural =
      scene.glb.addMaterial({.name = "mural", .texture = scene.glb.addTexture("mural", paintMural(), Wrap::clamp)});
  scene.glb.add("mural", makeRectangle({0, 0, -7.0f}, {4.75f, 0, 0}, {0, 2.67f, 0}), mural, {.uvs = true});

  Shot shot;
  shot.name = name;
  shot.description = "carved stones close to the lens over stones in focus at 2.5 m and a mural at 7 m";
  shot.camera = {.position = {0, 0, 0}, .target = {0, 0, -1}, .fovyDeg = 40.0f};
  shot.lens = {.apertureRadius = 0.045, .focusDistance = 2.5};
  shot.background = {0.3, 0.35, 0.4};
  scene.shots.push_back(shot);
  return scene;
}

}  // namespace scenes
