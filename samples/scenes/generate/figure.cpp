// A toy bear whose body is one closed cage of quads, made for Catmull–Clark subdivision, three times at three
// depths on a floor, under three lights and a studio environment. The camera is the glTF's own.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "generate/quad_cage.h"
#include "generate/scene.h"

namespace scenes {
namespace {

constexpr float kCellSize = 0.045f;  // m: the bear stands 0.7 m high.
constexpr float kShoulder = 6.5f;    // Cells above the soles.

/// Head and trunk are blocks of cells: most of the way to a ball and to a barrel.
void roundOff(QuadCage& cage) {
  constexpr float kShare = 0.7f;
  const glm::vec3 headCenter(0.0f, 11.5f, 0.0f);
  for (glm::vec3& p : cage.positions) {
    if (p.y > 14.1f) {  // ears sink with the skull beneath them
      p.x *= 0.86f;
      p.y -= 0.55f;
    } else if (p.y > 8.9f && p.z < 3.5f) {
      const glm::vec3 ball =
          headCenter + glm::normalize((p - headCenter) * glm::vec3(0.9f, 1.1f, 1.1f)) * glm::vec3(3.9f, 3.0f, 3.3f);
      p = glm::mix(p, ball, kShare);
    } else if (p.y > 2.9f && p.y < 8.1f && std::abs(p.x) < 3.05f && p.z > -2.6f) {
      const float bulge = 2.75f - 0.09f * (p.y - 4.8f) * (p.y - 4.8f);
      const glm::vec2 flat(p.x, p.z);
      if (glm::length(flat) < 1.5f) continue;
      const glm::vec2 barrel = glm::normalize(flat) * bulge;
      p = glm::mix(p, glm::vec3(barrel.x, p.y, barrel.y * 0.85f), kShare);
    }
  }
}

QuadCage sculptBear() {
  Cells cells;
  addMirrored(cells, {1, 0, -1}, {2, 3, 0});     // legs
  addMirrored(cells, {1, 0, 1}, {2, 0, 1});      // feet
  addMirrored(cells, {0, 3, -2}, {2, 7, 1});     // trunk
  addMirrored(cells, {3, 6, -1}, {6, 7, 0});     // arms
  addMirrored(cells, {0, 8, -1}, {1, 8, 0});     // neck
  addMirrored(cells, {0, 9, -3}, {3, 13, 2});    // head
  addMirrored(cells, {2, 14, -1}, {3, 15, -1});  // ears
  addMirrored(cells, {0, 10, 3}, {0, 11, 3});    // muzzle
  addMirrored(cells, {0, 4, -3}, {0, 4, -3});    // tail
  QuadCage cage = QuadCage::around(cells);
  for (glm::vec3& p : cage.positions) {
    // Arms hang: turned down about the shoulders, more to the left than to the right.
    const float beyond = std::abs(p.x) - 3.0f;
    if (beyond > 0.0f && p.y > 5.5f && p.y < 8.5f) {
      const float side = p.x > 0.0f ? 1.0f : -1.0f;
      const float angle = (p.x > 0.0f ? -0.55f : 0.45f) * std::min(1.0f, beyond / 1.5f);
      const float rise = p.y - (kShoulder + 0.5f);
      p.x = side * (3.0f + beyond * std::cos(angle) - rise * std::sin(angle));
      p.y = kShoulder + 0.5f + beyond * std::sin(angle) + rise * std::cos(angle);
      p.z += 0.35f * beyond;
    }
    if (p.y > 2.5f && p.y < 8.5f) p.z += 0.12f * (p.y - 5.0f) * (p.z > 0.0f ? -1.0f : 0.3f);
  }
  roundOff(cage);
  cage.relax(0.5f, 2);
  cage.inflate(0.22f);
  float lowest = 0.0f;
  for (const glm::vec3& p : cage.positions) lowest = std::min(lowest, p.y);
  for (glm::vec3& p : cage.positions) p = (p - glm::vec3(0, lowest, 0)) * kCellSize;
  return cage;
}

glm::vec4 furColor(glm::vec3 position) {
  const glm::vec3 p = position / kCellSize;
  const glm::vec3 fur(0.42f, 0.20f, 0.075f);
  const glm::vec3 pale(0.80f, 0.60f, 0.36f);
  const float belly = 1.0f - glm::smoothstep(1.6f, 2.6f, glm::length(glm::vec2(p.x, (p.y - 5.6f) * 0.8f)));
  const float muzzle = 1.0f - glm::smoothstep(1.2f, 2.0f, glm::length(glm::vec2(p.x, p.y - 11.0f)));
  const float front = glm::smoothstep(0.3f, 1.2f, p.z);
  const float inEar = p.y > 14.6f && p.z > -0.6f ? 0.6f : 0.0f;
  return glm::vec4(glm::mix(fur, pale, std::max({belly * front, muzzle * front, inEar})), 1.0f);
}

/// Depth of the front surface at (x, y), by asking every triangle.
float frontAt(const Mesh& mesh, glm::vec2 at) {
  float front = -1e9f;
  for (size_t i = 0; i < mesh.indices.size(); i += 3) {
    const glm::vec3 a = mesh.vertices[mesh.indices[i]].position;
    const glm::vec3 b = mesh.vertices[mesh.indices[i + 1]].position;
    const glm::vec3 c = mesh.vertices[mesh.indices[i + 2]].position;
    const glm::vec2 u(b - a);
    const glm::vec2 v(c - a);
    const glm::vec2 w = at - glm::vec2(a);
    const float area = u.x * v.y - u.y * v.x;
    if (area <= 1e-12f) continue;
    const float s = (w.x * v.y - w.y * v.x) / area;
    const float t = (u.x * w.y - u.y * w.x) / area;
    if (s >= 0.0f && t >= 0.0f && s + t <= 1.0f) front = std::max(front, a.z + s * (b.z - a.z) + t * (c.z - a.z));
  }
  return front;
}

/// Eyes, nose and buttons: glossy beads set into the front.
Mesh makeBeads(const Mesh& bear) {
  Mesh beads;
  const auto bead = [&](glm::vec2 cellsXy, glm::vec3 radius) {
    const glm::vec2 at = cellsXy * kCellSize;
    const glm::mat4 place = glm::translate(glm::mat4(1.0f), glm::vec3(at, frontAt(bear, at)));
    append(beads, transformed(makeSphere(10, 16), glm::scale(place, radius)));
  };
  bead({-1.75f, 12.6f}, glm::vec3(0.021f, 0.024f, 0.016f));
  bead({1.75f, 12.6f}, glm::vec3(0.021f, 0.024f, 0.016f));
  bead({0.0f, 11.9f}, glm::vec3(0.027f, 0.019f, 0.018f));
  return beads;
}

/// A scarf: a ring of quads that closes on itself.
QuadCage makeScarf() {
  constexpr uint32_t kAround = 18;
  constexpr uint32_t kSection = 6;
  QuadCage cage;
  for (uint32_t i = 0; i < kAround; ++i) {
    const float u = glm::two_pi<float>() * static_cast<float>(i) / kAround;
    for (uint32_t j = 0; j < kSection; ++j) {
      const float v = glm::two_pi<float>() * static_cast<float>(j) / kSection;
      const float radius = 2.5f + 0.75f * std::cos(v) + 0.12f * std::sin(5.0f * u);
      cage.positions.push_back(
          glm::vec3(radius * std::sin(u), 8.75f + 0.8f * std::sin(v), radius * 0.95f * std::cos(u) - 0.15f) *
          kCellSize);
    }
  }
  for (uint32_t i = 0; i < kAround; ++i) {
    for (uint32_t j = 0; j < kSection; ++j) {
      const uint32_t nextI = (i + 1) % kAround;
      const uint32_t nextJ = (j + 1) % kSection;
      cage.quads.push_back({i * kSection + j, nextI * kSection + j, nextI * kSection + nextJ, i * kSection + nextJ});
    }
  }
  return cage;
}

Canvas paintFloor() {
  Canvas canvas(128, 128);
  canvas.paint([](glm::vec2 uv) {
    const float plank = std::floor(uv.x * 4.0f);
    const float joint = std::fmod(uv.y + plank * 0.37f, 1.0f);
    const bool gap = std::fmod(uv.x * 4.0f, 1.0f) < 0.05f || joint < 0.012f;
    const float grain = tilingNoise(uv * glm::vec2(32, 4), 32, 21);
    const float tone = 0.8f + 0.05f * plank - 0.16f * std::round(grain * 6.0f) / 6.0f;
    return glm::vec4(glm::vec3(0.72f, 0.56f, 0.40f) * (gap ? 0.4f : tone), 1.0f);
  });
  return canvas;
}

Canvas paintNursery() {
  Canvas canvas(256, 128);
  canvas.paint([](glm::vec2 uv) {
    const glm::vec2 cell = uv * glm::vec2(16, 8);
    const float shift = std::fmod(std::floor(cell.y), 2.0f) * 0.5f;
    const glm::vec2 inCell(std::fmod(cell.x + shift, 1.0f) - 0.5f, cell.y - std::floor(cell.y) - 0.5f);
    const float spot = 1.0f - glm::smoothstep(0.2f, 0.26f, glm::length(inCell));
    return glm::vec4(glm::mix(glm::vec3(0.55f, 0.68f, 0.72f), glm::vec3(0.93f, 0.88f, 0.74f), spot), 1.0f);
  });
  return canvas;
}

void addRoom(Glb& glb) {
  const int planks = glb.addMaterial({.name = "planks",
                                      .texture = glb.addTexture("planks", paintFloor(), Wrap::repeat),
                                      .unlit = false,
                                      .roughness = 0.45f});
  const Mesh floor = makeRectangle({0, 0, -1.5f}, {4.5f, 0, 0}, {0, 0, -4.0f}, {12, 10});
  glb.add("floor", floor, planks, {.normals = true, .uvs = true});
  const int paper = glb.addMaterial({.name = "wallpaper",
                                     .texture = glb.addTexture("wallpaper", paintNursery(), Wrap::repeat),
                                     .unlit = false,
                                     .roughness = 0.9f});
  const Mesh wall = makeRectangle({0, 2.0f, -5.0f}, {4.5f, 0, 0}, {0, 2.0f, 0}, {2, 2});
  glb.add("wall", wall, paper, {.normals = true, .uvs = true});
  glb.addLight({.name = "key", .type = "directional", .color = {1.0f, 0.93f, 0.82f}, .intensity = 2.4f}, {2, 3, 2},
               {0, 0, -0.6f});
  glb.addLight({.name = "lamp", .type = "point", .color = {1.0f, 0.7f, 0.4f}, .intensity = 1.6f}, {-1.4f, 1.3f, -1.6f},
               {-1.4f, 0.0f, -1.6f});
  glb.addLight(
      {.name = "rim", .type = "spot", .color = {0.6f, 0.75f, 1.0f}, .intensity = 14.0f, .outerConeAngle = 0.5f},
      {1.6f, 2.2f, -2.8f}, {0, 0.4f, 0});
}

}  // namespace

Scene makeFigure() {
  Scene scene;
  Glb& glb = scene.glb;
  addRoom(glb);
  Mesh bear = sculptBear().triangulated();
  for (Vertex& vertex : bear.vertices) vertex.color = furColor(vertex.position);
  const int fur = glb.addMaterial({.name = "plush", .unlit = false, .roughness = 0.85f});
  const int gloss =
      glb.addMaterial({.name = "beads", .baseColor = {0.02f, 0.015f, 0.015f, 1}, .unlit = false, .roughness = 0.12f});
  const int wool =
      glb.addMaterial({.name = "scarf", .baseColor = {0.65f, 0.06f, 0.05f, 1}, .unlit = false, .roughness = 0.8f});
  const int bearMesh = glb.addMesh("bear", bear, fur, {.normals = true, .colors = true}, QuadCage::extras());
  const int beadMesh = glb.addMesh("beads", makeBeads(bear), gloss, {.normals = true});
  const int scarfMesh = glb.addMesh("scarf", makeScarf().triangulated(), wool, {.normals = true}, QuadCage::extras());
  struct Stand {
    glm::vec3 at;
    float yaw;
  };
  for (const Stand& stand : {Stand{{0.06f, 0, 0}, -0.12f}, Stand{{-0.56f, 0, 0.95f}, 0.5f},
                             Stand{{0.95f, 0, -2.1f}, -0.45f}, Stand{{-0.95f, 0, -2.9f}, 0.3f}}) {
    const Placement place{.translation = stand.at, .rotation = glm::angleAxis(stand.yaw, glm::vec3(0, 1, 0))};
    glb.addNode("bear", bearMesh, place);
    glb.addNode("beads", beadMesh, place);
    glb.addNode("scarf", scarfMesh, place);
  }

  const glm::vec3 eye(0.0f, 0.62f, 2.1f);
  const glm::vec3 target(0.0f, 0.40f, 0.0f);
  constexpr float kFovyDeg = 30.0f;
  glb.addCamera("portrait", glm::radians(kFovyDeg), eye, target);
  Shot shot;
  shot.name = "figure";
  shot.description = "toy bears of quad cages, one in focus at 2 m, lit, seen by the scene's own camera";
  shot.camera = {.position = eye, .target = target, .fovyDeg = kFovyDeg, .gltfName = "portrait"};
  shot.lens = {.focusDistance = 1.98, .focalLengthMm = 85.0, .fStop = 1.4};
  shot.background = {0.2, 0.25, 0.3};
  shot.lit = true;
  shot.environment = "studio.exr";
  scene.shots.push_back(shot);
  return scene;
}

}  // namespace scenes
