// Branching follows one rule at every level: segments turn at random and towards a pull; see plants.h.
#include "parts/plants.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <span>

#include "parts/shapes.h"

namespace scenes {
namespace {

struct Growth {
  glm::vec3 start;
  glm::vec3 direction;
  float length;
  float radius;
  float wander;    ///< Random turn at each segment.
  glm::vec3 pull;  ///< Added to the direction at each segment.
  int segments;
  float tip = 0.1f;  ///< Radius at the end as a share of that at the start.
};

std::vector<TubePoint> grow(const Growth& growth, Random& random) {
  std::vector<TubePoint> path;
  glm::vec3 direction = glm::normalize(growth.direction);
  glm::vec3 position = growth.start;
  for (int i = 0; i <= growth.segments; ++i) {
    const float t = static_cast<float>(i) / static_cast<float>(growth.segments);
    path.push_back({position, growth.radius * glm::mix(1.0f, growth.tip, t)});
    direction = glm::normalize(direction + random.cube() * growth.wander + growth.pull);
    position += direction * (growth.length / static_cast<float>(growth.segments));
  }
  return path;
}

TubePoint along(std::span<const TubePoint> path, float t) {
  const float at = std::clamp(t, 0.0f, 1.0f) * static_cast<float>(path.size() - 1);
  const auto segment = std::min(static_cast<size_t>(at), path.size() - 2);
  const float rest = at - static_cast<float>(segment);
  return {glm::mix(path[segment].position, path[segment + 1].position, rest),
          glm::mix(path[segment].radius, path[segment + 1].radius, rest)};
}

glm::vec3 directionAt(std::span<const TubePoint> path, float t) {
  const glm::vec3 step = along(path, t + 0.05f).position - along(path, t - 0.05f).position;
  return glm::dot(step, step) > 0.0f ? glm::normalize(step) : glm::vec3(0, 1, 0);
}

struct Foliage {
  int count;
  float size;
  glm::vec3 tint;
  float light;  ///< Of the place; multiplies the tint.
};

void addLeaves(Mesh& leaves, std::span<const TubePoint> twig, const Foliage& foliage, Random& random) {
  for (int i = 0; i < foliage.count; ++i) {
    const float t = 0.15f + 0.85f * (static_cast<float>(i) + random.unit()) / static_cast<float>(foliage.count);
    const glm::vec3 forward = directionAt(twig, t);
    const glm::vec3 outward = glm::normalize(forward * 0.7f + random.cube() + glm::vec3(0, -0.15f, 0));
    const float size = foliage.size * random.between(0.7f, 1.2f);
    Mesh leaf = makeFoldedLeaf(size, size * 0.55f, 0.09f, random.between(0.05f, 0.3f));
    const float tone = foliage.light * random.between(0.7f, 1.25f);
    const glm::vec3 color =
        foliage.tint * tone * glm::vec3(random.between(0.85f, 1.25f), 1.0f, random.between(0.7f, 1.1f));
    leaf = colored(leaf, glm::vec4(glm::clamp(color, 0.0f, 1.0f), 1.0f));
    append(leaves, transformed(leaf, standingAlong(along(twig, t).position, outward, random.between(0.0f, 6.28f))));
  }
}

Mesh barkTube(std::span<const TubePoint> path, int sides, float around) {
  Mesh tube = makeTube(path, sides);
  scaleUv(tube, {around, 1.0f / 0.6f});
  return tube;
}

/// One side leaf of a fern's frond.
struct Leaflet {
  glm::vec3 at;
  glm::vec3 forward;  ///< Of the frond.
  float size;         ///< m
  glm::vec3 color;
};

/// side: +1 or −1, which side of the frond. A narrow kite with a raised rib and a tip that droops.
void addLeaflet(Mesh& fern, const Leaflet& leaflet, float side, Random& random) {
  const glm::vec3 across = glm::normalize(glm::cross(leaflet.forward, glm::vec3(0, 1, 0)) + glm::vec3(1e-4f, 0, 0));
  const glm::vec3 upper = glm::normalize(glm::cross(across, leaflet.forward));
  const glm::vec3 lift = upper * random.between(-0.35f, 0.15f);
  const glm::vec3 way = glm::normalize(across * side + leaflet.forward * 0.4f + lift);
  const glm::vec3 width = glm::normalize(glm::cross(upper, way)) * leaflet.size * 0.062f;
  const glm::vec3 middle = leaflet.at + way * leaflet.size * 0.35f;
  const std::array<glm::vec3, 5> points = {leaflet.at, middle + width, middle - width,
                                           middle + way * leaflet.size * 0.15f + upper * leaflet.size * 0.05f,
                                           leaflet.at + way * leaflet.size - upper * leaflet.size * 0.14f};
  Mesh kite;
  const glm::vec4 color(leaflet.color * random.between(0.75f, 1.2f), 1.0f);
  for (const glm::vec3 point : points) kite.vertices.push_back({point, upper, {0.5f, 0.5f}, color});
  kite.indices = {0, 3, 1, 0, 2, 3, 1, 3, 4, 2, 4, 3};
  smoothNormals(kite);
  append(fern, kite);
}

}  // namespace

Plant makeTree(const TreeShape& shape, Random& random) {
  Plant tree;
  const std::vector<TubePoint> trunk = [&] {
    std::vector<TubePoint> path = grow({.start = {0, -0.1f, 0},
                                        .direction = {random.between(-0.06f, 0.06f), 1, random.between(-0.06f, 0.06f)},
                                        .length = shape.height,
                                        .radius = shape.trunkRadius,
                                        .wander = 0.05f,
                                        .pull = {0, 0.04f, 0},
                                        .segments = 28,
                                        .tip = 0.12f},
                                       random);
    path[0].radius *= 1.7f;  // The roots' flare.
    path[1].radius *= 1.12f;
    return path;
  }();
  append(tree.wood, barkTube(trunk, 18, std::max(1.0f, std::round(shape.trunkRadius * 10.0f))));
  for (int i = 0; i < shape.branches; ++i) {
    const float share = (static_cast<float>(i) + random.between(0.1f, 0.9f)) / static_cast<float>(shape.branches);
    const float t = glm::mix(shape.bareShare, 0.97f, share);
    const TubePoint base = along(trunk, t);
    const float angle = 2.4f * static_cast<float>(i) + random.between(-0.4f, 0.4f);  // Golden angle: no gaps around.
    const glm::vec3 out(std::cos(angle), random.between(0.25f, 0.6f), std::sin(angle));
    const float length = shape.height * shape.spread * (1.05f - share) * random.between(0.8f, 1.15f);
    const std::vector<TubePoint> branch =
        grow({base.position, out, length, base.radius * 0.5f, 0.13f, {0, 0.03f, 0}, 9}, random);
    append(tree.wood, barkTube(branch, 7, 1.0f));
    for (int j = 0; j < shape.twigs; ++j) {
      const float u = 0.25f + 0.75f * (static_cast<float>(j) + random.unit()) / static_cast<float>(shape.twigs);
      const TubePoint knot = along(branch, u);
      const glm::vec3 way = directionAt(branch, u) * 0.6f + random.cube();
      const std::vector<TubePoint> twig = grow({knot.position,
                                                way,
                                                length * random.between(0.2f, 0.36f),
                                                std::max(0.004f, knot.radius * 0.4f),
                                                0.2f,
                                                {0, -0.02f, 0},
                                                4},
                                               random);
      append(tree.wood, barkTube(twig, 4, 1.0f));
      // Deep inside the crown little light arrives.
      const float light = glm::mix(0.35f, 1.0f, u) * glm::mix(0.7f, 1.0f, share);
      addLeaves(tree.leaves, twig, {shape.leaves, shape.leafSize, shape.leafTint, light}, random);
    }
  }
  return tree;
}

Plant makeBranch(float length, float leafSize, int twigs, int leaves, glm::vec3 tint, Random& random) {
  Plant plant;
  const std::vector<TubePoint> branch =
      grow({glm::vec3(0.0f), {1, 0.1f, 0}, length, 0.008f + length * 0.006f, 0.10f, {0, -0.05f, 0}, 14}, random);
  append(plant.wood, barkTube(branch, 12, 1.0f));
  for (int i = 0; i < twigs; ++i) {
    const float t = 0.2f + 0.8f * (static_cast<float>(i) + random.unit()) / static_cast<float>(twigs);
    const glm::vec3 way = directionAt(branch, t) + random.cube() * 0.9f;
    const std::vector<TubePoint> twig =
        grow({along(branch, t).position, way, length * random.between(0.16f, 0.3f), 0.004f, 0.15f, {0, -0.06f, 0}, 6},
             random);
    append(plant.wood, barkTube(twig, 6, 1.0f));
    addLeaves(plant.leaves, twig, {leaves, leafSize, tint, 1.0f}, random);
  }
  return plant;
}

Mesh makeFern(float length, int fronds, int leafletPairs, Random& random) {
  Mesh fern;
  for (int i = 0; i < fronds; ++i) {
    const float angle =
        glm::two_pi<float>() * (static_cast<float>(i) + random.between(-0.3f, 0.3f)) / static_cast<float>(fronds);
    const glm::vec3 out(std::cos(angle), 0, std::sin(angle));
    const float reach = length * random.between(0.7f, 1.1f);
    const glm::vec3 pull = out * 0.07f + glm::vec3(0, random.between(-0.12f, -0.05f), 0);
    const std::vector<TubePoint> rachis =
        grow({out * 0.02f, out * 0.5f + glm::vec3(0, 1.0f, 0), reach, 0.005f, 0.05f, pull, 12}, random);
    append(fern, colored(makeTube(rachis, 4), {0.26f, 0.24f, 0.08f, 1}));
    const float tone = random.between(0.65f, 1.15f);
    for (int j = 0; j < leafletPairs; ++j) {
      const float t = 0.16f + 0.82f * static_cast<float>(j) / static_cast<float>(leafletPairs);
      const float taper = std::sin(glm::pi<float>() * std::pow(1.0f - 0.93f * t, 0.8f) * 0.95f + 0.06f);
      const Leaflet leaflet{.at = along(rachis, t).position,
                            .forward = directionAt(rachis, t),
                            .size = reach * 0.27f * taper,
                            .color = glm::vec3(0.30f, 0.42f, 0.10f) * tone * glm::mix(0.45f, 1.2f, t)};
      addLeaflet(fern, leaflet, 1.0f, random);
      addLeaflet(fern, leaflet, -1.0f, random);
    }
  }
  return fern;
}

Mesh makeGrass(float height, int blades, Random& random) {
  Mesh grass;
  for (int i = 0; i < blades; ++i) {
    const float angle = random.between(0.0f, glm::two_pi<float>());
    const float distance = 0.14f * std::sqrt(random.unit());
    const glm::vec3 foot(std::cos(angle) * distance, -0.01f, std::sin(angle) * distance);
    const glm::vec3 lean =
        glm::normalize(glm::vec3(foot.x, 0, foot.z) + random.cube() * 0.08f) * random.between(0.1f, 0.6f);
    const glm::vec3 across = glm::normalize(glm::vec3(-lean.z, 0, lean.x) + glm::vec3(1e-4f, 0, 0)) * 0.0035f;
    const float tall = height * random.between(0.55f, 1.1f);
    const auto first = static_cast<uint32_t>(grass.vertices.size());
    const float tone = random.between(0.7f, 1.2f);
    for (int row = 0; row < 3; ++row) {
      const float t = static_cast<float>(row) / 3.0f;
      const glm::vec3 center = foot + glm::vec3(lean.x * t * t, t - 0.3f * t * t, lean.z * t * t) * tall;
      const glm::vec4 color(glm::vec3(0.34f, 0.44f, 0.12f) * tone * (0.45f + 0.7f * t), 1.0f);
      for (const float sign : {-1.0f, 1.0f}) {
        grass.vertices.push_back({center + across * (sign * (1.0f - 0.5f * t)), {0, 1, 0}, {0, 0}, color});
      }
    }
    const glm::vec3 tip = foot + glm::vec3(lean.x, 0.7f, lean.z) * tall;
    grass.vertices.push_back({tip, {0, 1, 0}, {0, 0}, glm::vec4(glm::vec3(0.42f, 0.52f, 0.18f) * tone, 1.0f)});
    for (const uint32_t a : {0u, 2u}) {
      grass.indices.insert(grass.indices.end(),
                           {first + a, first + a + 1, first + a + 3, first + a, first + a + 3, first + a + 2});
    }
    grass.indices.insert(grass.indices.end(), {first + 4, first + 5, first + 6});
  }
  smoothNormals(grass);
  return grass;
}

Mesh makeMushroom(float height, Random& random) {
  const float lean = random.between(-0.1f, 0.1f);
  const std::array<glm::vec2, 6> stem = {glm::vec2(0.0f, -0.05f), {0.14f, -0.05f}, {0.11f, 0.15f},
                                         {0.08f, 0.5f},           {0.085f, 0.8f},  {0.0f, 0.82f}};
  const std::array<glm::vec2, 11> cap = {glm::vec2(0.0f, 0.72f), {0.08f, 0.71f}, {0.36f, 0.66f}, {0.43f, 0.66f},
                                         {0.44f, 0.70f},         {0.42f, 0.78f}, {0.36f, 0.87f}, {0.27f, 0.94f},
                                         {0.16f, 0.985f},        {0.06f, 1.0f},  {0.0f, 1.0f}};
  Mesh mushroom = colored(makeLathe(stem, 20), {0.75f, 0.66f, 0.50f, 1});
  Mesh top = makeLathe(cap, 28);
  for (Vertex& vertex : top.vertices) {
    const float under = vertex.normal.y < -0.2f ? 1.0f : 0.0f;
    const float rise = glm::clamp((vertex.position.y - 0.66f) / 0.34f, 0.0f, 1.0f);
    const glm::vec3 upper = glm::mix(glm::vec3(0.66f, 0.30f, 0.07f), glm::vec3(0.42f, 0.11f, 0.03f), rise);
    vertex.color = glm::vec4(glm::mix(upper, glm::vec3(0.62f, 0.52f, 0.34f), under), 1.0f);
  }
  append(mushroom, top);
  const glm::mat4 shear(glm::vec4(1, 0, 0, 0), glm::vec4(lean, 1, lean * 0.5f, 0), glm::vec4(0, 0, 1, 0),
                        glm::vec4(0, 0, 0, 1));
  return transformed(mushroom, glm::scale(glm::mat4(1.0f), glm::vec3(height)) * shear);
}

Canvas paintLeafTexture() {
  Canvas canvas(128, 256);
  canvas.paint([](glm::vec2 uv) {
    const float x = std::abs(uv.x - 0.5f) * 2.0f;
    const float y = 1.0f - uv.y;  // 0 at the stalk, 1 at the tip
    const float blade = std::clamp((y - 0.06f) / 0.92f, 0.0f, 1.0f);
    const float serration = 0.04f * std::abs(std::fmod(blade * 15.0f, 1.0f) - 0.5f);
    const float halfWidth = 0.97f * std::pow(std::sin(glm::pi<float>() * std::pow(blade, 0.7f)), 0.8f) - serration;
    const float inside = std::max(halfWidth, y < 0.5f ? 0.05f : 0.0f) - x;
    const float rib = std::abs(std::fmod(blade * 7.0f - x * 0.9f + 8.0f, 1.0f) - 0.5f);
    const float vein =
        std::max(1.0f - glm::smoothstep(0.02f, 0.05f, x), 0.6f * (1.0f - glm::smoothstep(0.03f, 0.09f, rib)));
    const float grain = tilingClouds(uv * glm::vec2(8, 16), 16, 5u, 3);
    const glm::vec3 color =
        glm::mix(glm::vec3(0.78f, 0.88f, 0.62f) * (0.8f + 0.3f * grain), glm::vec3(0.95f, 0.97f, 0.75f), vein);
    // Beyond the outline the color goes on, so that filtering mixes no foreign color in.
    return glm::vec4(color, std::clamp(0.5f + inside * 20.0f, 0.0f, 1.0f));
  });
  return canvas;
}

}  // namespace scenes
