// Thin tapered branches that pass through the focal plane and cross one another (after Lee 2009, fig. 8): two
// that nearly touch on either side of the focal plane look separated through the lens. Behind them, hills.
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "generate/random.h"
#include "generate/scene.h"

namespace scenes {
namespace {

constexpr float kThinnest = 0.0035f;  // m: about one pixel at the focal plane.

struct Branch {
  glm::vec3 start;
  glm::vec3 direction;  ///< Unit.
  float length;         ///< m
  float radius;         ///< m at its start
  int generation;
};

void growBranch(Mesh& mesh, Random& random, const Branch& branch) {
  constexpr int kSegments = 6;
  std::vector<TubePoint> path = {{branch.start, branch.radius}};
  glm::vec3 direction = branch.direction;
  const float step = branch.length / kSegments;
  for (int i = 1; i <= kSegments; ++i) {
    const glm::vec3 bend = random.cube() * (branch.generation == 0 ? 0.07f : 0.16f);
    direction = glm::normalize(direction + bend + glm::vec3(0, 0.015f * static_cast<float>(branch.generation), 0));
    const float taper = 1.0f - 0.72f * static_cast<float>(i) / kSegments;
    path.push_back({path.back().position + direction * step, std::max(branch.radius * taper, 0.6f * kThinnest)});
    if (branch.generation >= 3 || i < 2 || (branch.generation > 0 && i % 2 == 0)) continue;
    const glm::vec3 side = glm::normalize(glm::cross(direction, random.cube()));
    const float lean = random.between(0.45f, 0.9f);
    growBranch(
        mesh, random,
        {path.back().position, glm::normalize(direction + side * lean), branch.length * random.between(0.32f, 0.5f),
         std::max(path.back().radius * 0.6f, kThinnest), branch.generation + 1});
  }
  const float tone = random.between(0.8f, 1.2f);
  const glm::vec3 bark = branch.generation == 0 ? glm::vec3(0.30f, 0.21f, 0.15f) : glm::vec3(0.36f, 0.24f, 0.16f);
  append(mesh, colored(makeTube(path, branch.generation == 0  ? 10
                                      : branch.generation < 3 ? 5
                                                              : 4),
                       glm::vec4(bark * tone, 1.0f)));
  if (branch.generation < 2) return;
  const glm::mat4 bud = standingAlong(path.back().position, direction);
  Mesh tip = makeSphere(4, 5);
  for (Vertex& vertex : tip.vertices) vertex.position *= glm::vec3(0.007f, 0.013f, 0.007f);
  append(mesh, colored(transformed(tip, bud), {0.75f, 0.22f, 0.20f, 1.0f}));
}

/// A straight limb between two points, with twigs only where asked.
void addLimb(Mesh& mesh, Random& random, glm::vec3 from, glm::vec3 to, float radius, int generation) {
  growBranch(mesh, random, {from, glm::normalize(to - from), glm::length(to - from), radius, generation});
}

/// Three pairs of straight rods, each an X in the picture: one rod crosses the middle before 2.5 m, the other
/// behind it, by less from pair to pair, until in the last they touch.
void addCrossedRods(Mesh& mesh) {
  struct Rod {
    float slope;        ///< Horizontal tangent from its middle to its top.
    float bottomDepth;  ///< m
    float topDepth;     ///< m
    glm::vec4 color;
  };
  constexpr float kBottom = -0.275f;  // Vertical tangents of the ends.
  constexpr float kTop = -0.005f;
  // m; close to half the distance between the rods of a pair where they cross.
  constexpr std::array<float, 3> kGaps = {0.60f, 0.20f, 0.006f};
  for (size_t pair = 0; pair < kGaps.size(); ++pair) {
    const float middle = -0.4f + 0.4f * static_cast<float>(pair);
    const float gap = kGaps[pair];
    const std::array<Rod, 2> rods = {Rod{0.075f, 1.85f - gap, 3.85f - gap * 2.0f, {0.85f, 0.75f, 0.5f, 1}},
                                     Rod{-0.075f, 3.85f + gap * 2.0f, 1.85f + gap, {0.35f, 0.5f, 0.55f, 1}}};
    for (const Rod& rod : rods) {
      const glm::vec3 bottom = glm::vec3(middle - rod.slope, kBottom, -1.0f) * rod.bottomDepth;
      const glm::vec3 top = glm::vec3(middle + rod.slope, kTop, -1.0f) * rod.topDepth;
      const std::array<TubePoint, 2> path = {TubePoint{bottom, 0.006f}, TubePoint{top, 0.006f}};
      append(mesh, colored(makeTube(path, 8), rod.color));
    }
  }
}

Canvas paintLandscape() {
  Canvas canvas(512, 256);
  canvas.paint([](glm::vec2 uv) {
    glm::vec3 color = glm::mix(glm::vec3(0.55f, 0.70f, 0.88f), glm::vec3(0.96f, 0.88f, 0.74f), uv.y * 1.5f);
    for (int ridge = 0; ridge < 4; ++ridge) {
      const auto depth = static_cast<float>(ridge);
      const float height =
          0.42f + 0.13f * depth - 0.16f * tilingClouds({uv.x * (4.0f + 2.0f * depth), depth * 3.0f + 0.5f}, 32, 40u, 5);
      if (uv.y < height) continue;
      const float grain = tilingNoise(uv * (48.0f + 16.0f * depth), 256, 77u);
      color = glm::mix(glm::vec3(0.56f, 0.64f, 0.72f), glm::vec3(0.22f, 0.34f, 0.16f), depth / 3.0f);
      if (ridge > 1) color *= 0.8f + 0.4f * std::round(grain * 4.0f) / 4.0f;
    }
    return glm::vec4(color, 1.0f);
  });
  return canvas;
}

}  // namespace

Scene makeCrossingBranches() {
  Scene scene;
  Random random(2009);
  Mesh branches;
  // Crossings: each pair meets in the picture where one passes just before and one just behind 2.5 m.
  addLimb(branches, random, {-0.75f, -0.62f, -1.45f}, {0.62f, 0.60f, -3.9f}, 0.021f, 0);
  addLimb(branches, random, {1.15f, -1.3f, -3.9f}, {-0.42f, 0.52f, -1.5f}, 0.021f, 0);
  addLimb(branches, random, {-1.9f, 0.15f, -2.75f}, {1.7f, 0.38f, -2.3f}, 0.016f, 0);
  addLimb(branches, random, {0.62f, -0.5f, -1.2f}, {0.85f, 1.0f, -2.6f}, 0.014f, 1);
  addLimb(branches, random, {-0.55f, 0.42f, -1.02f}, {0.2f, 0.10f, -1.3f}, 0.007f, 2);
  addLimb(branches, random, {-2.4f, -1.5f, -5.2f}, {-1.4f, 1.3f, -4.6f}, 0.045f, 0);
  addLimb(branches, random, {2.0f, -1.5f, -4.4f}, {1.5f, 1.4f, -5.4f}, 0.04f, 0);
  addCrossedRods(branches);
  bakeLight(branches, {.sun = {1.0f, 0.95f, 0.8f}});
  scene.glb.add("branches", branches, scene.glb.addMaterial({.name = "bark"}), {.colors = true});
  const int hills =
      scene.glb.addMaterial({.name = "hills", .texture = scene.glb.addTexture("hills", paintLandscape(), Wrap::clamp)});
  scene.glb.add("hills", makeRectangle({0, 0.1f, -8.0f}, {4.9f, 0, 0}, {0, 2.75f, 0}), hills, {.uvs = true});

  Shot shot;
  shot.name = "crossing_branches";
  shot.description = "thin branches and rods crossing through the focal plane at 2.5 m";
  shot.camera = {.position = {0, 0, 0}, .target = {0, 0, -1}, .fovyDeg = 35.0f};
  shot.lens = {.apertureRadius = 0.045, .focusDistance = 2.5};
  shot.background = {0.5, 0.6, 0.75};
  scene.shots.push_back(shot);
  return scene;
}

}  // namespace scenes
