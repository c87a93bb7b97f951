// Coloured alpha-blended panes before, at and behind focus, some one behind another, over opaque content. Two
// carry stripes in their texture's alpha, one a ramp in its vertex alpha, and one pair intersects, so no
// order by object or triangle is right: each pixel must sort its own.
#include <cmath>
#include <glm/common.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>

#include "generate/scene.h"

namespace scenes {
namespace {

constexpr float kFocus = 2.5f;  // m

Canvas paintStripes() {
  Canvas canvas(64, 64);
  canvas.paint([](glm::vec2 uv) {
    const float wave = std::abs(std::fmod(uv.x + uv.y, 0.5f) * 4.0f - 1.0f);  // 0…1…0 twice a tile
    const float alpha = glm::smoothstep(0.42f, 0.58f, wave);
    return glm::vec4(1.0f, 1.0f, 1.0f, 0.15f + 0.75f * alpha);
  });
  return canvas;
}

Canvas paintChecker() {
  Canvas canvas(64, 64);
  canvas.paint([](glm::vec2 uv) {
    const bool light = (uv.x < 0.5f) == (uv.y < 0.5f);
    const bool joint = std::fmod(uv.x, 0.5f) < 0.016f || std::fmod(uv.y, 0.5f) < 0.016f;
    const float value = joint ? 0.25f : light ? 0.78f : 0.42f;
    return glm::vec4(value, value * 0.97f, value * 0.9f, 1.0f);
  });
  return canvas;
}

Canvas paintWall() {
  Canvas canvas(512, 256, glm::vec4(0.86f, 0.84f, 0.78f, 1.0f));
  for (int row = 0; row < 8; ++row) {
    for (int column = 0; column < 16; ++column) {
      const float hue = static_cast<float>(column) / 16.0f * 6.2831853f;
      const glm::vec3 color = 0.55f + 0.35f * glm::cos(glm::vec3(hue, hue - 2.094f, hue + 2.094f));
      const glm::vec3 shade = color * (0.55f + 0.06f * static_cast<float>(row));
      canvas.fill({column * 32 + 3, row * 32 + 3}, {26, 26}, glm::vec4(shade, 1.0f));
    }
  }
  canvas.fill({0, 112}, {512, 32}, {0.12f, 0.13f, 0.16f, 1.0f});
  canvas.writeCentered("GLASS BEFORE GLASS BEHIND GLASS BEFORE A WALL", {256, 119}, 1.8f, {0.95f, 0.9f, 0.7f, 1});
  return canvas;
}

struct Pane {
  const char* name;
  glm::vec3 center;
  glm::vec2 halfSize;
  float yaw;  ///< rad
  glm::vec4 color;
  bool striped;
};

/// A pane in its own axes, with a frame of four rods.
void addPane(Glb& glb, Mesh& frames, const Pane& pane, int stripes) {
  const Mesh sheet = makeRectangle({0, 0, 0}, {pane.halfSize.x, 0, 0}, {0, pane.halfSize.y, 0}, pane.halfSize * 6.0f);
  const int material = glb.addMaterial({.name = pane.name,
                                        .baseColor = pane.color,
                                        .texture = pane.striped ? stripes : -1,
                                        .alphaMode = AlphaMode::blend,
                                        .doubleSided = true});
  const glm::quat rotation = glm::angleAxis(pane.yaw, glm::vec3(0, 1, 0));
  const int mesh = glb.addMesh(pane.name, sheet, material, {.uvs = pane.striped});
  glb.addNode(pane.name, mesh, {.translation = pane.center, .rotation = rotation});
  Mesh frame;
  const float edge = 0.007f * -pane.center.z / kFocus + 0.002f;
  for (const float sign : {-1.0f, 1.0f}) {
    append(frame, makeBox({sign * (pane.halfSize.x + edge), 0, 0}, {edge, pane.halfSize.y + 2 * edge, edge}));
    append(frame, makeBox({0, sign * (pane.halfSize.y + edge), 0}, {pane.halfSize.x, edge, edge}));
  }
  const glm::mat4 place = glm::translate(glm::mat4(1.0f), pane.center) * glm::mat4_cast(rotation);
  append(frames, colored(transformed(frame, place), {0.30f, 0.20f, 0.12f, 1}));
}

void addPanes(Glb& glb, Mesh& frames) {
  const int stripes = glb.addTexture("stripes", paintStripes(), Wrap::repeat, true);
  const std::array<Pane, 9> panes = {{
      {"near amber", {-0.44f, -0.05f, -1.05f}, {0.16f, 0.20f}, 0.25f, {0.95f, 0.45f, 0.05f, 0.55f}, false},
      {"near blue stripes", {-0.24f, 0.10f, -1.30f}, {0.17f, 0.17f}, -0.2f, {0.08f, 0.25f, 0.85f, 1.0f}, true},
      {"near smoke", {0.50f, 0.12f, -1.15f}, {0.13f, 0.17f}, -0.3f, {0.05f, 0.05f, 0.06f, 0.4f}, false},
      {"focus crossing red", {0.02f, 0.02f, -kFocus}, {0.34f, 0.36f}, 0.62f, {0.9f, 0.06f, 0.08f, 0.6f}, false},
      {"focus crossing green", {0.02f, 0.02f, -kFocus}, {0.34f, 0.30f}, -0.62f, {0.05f, 0.65f, 0.15f, 0.6f}, false},
      {"focus yellow", {0.86f, -0.12f, -kFocus}, {0.24f, 0.34f}, 0.0f, {0.95f, 0.85f, 0.1f, 0.3f}, false},
      {"far violet stripes", {-0.75f, 0.05f, -3.7f}, {0.42f, 0.5f}, 0.1f, {0.45f, 0.1f, 0.7f, 1.0f}, true},
      {"far cyan", {-0.40f, -0.05f, -4.3f}, {0.5f, 0.55f}, 0.1f, {0.05f, 0.6f, 0.7f, 0.5f}, false},
      {"far rose", {1.15f, 0.05f, -4.0f}, {0.45f, 0.6f}, -0.15f, {0.9f, 0.3f, 0.45f, 0.8f}, false},
  }};
  for (const Pane& pane : panes) addPane(glb, frames, pane, stripes);
  // A veil whose alpha runs from 0 at the top to 0.9 at the bottom, through all of the middle.
  Mesh veil = makeRectangle({0.95f, -0.33f, -1.7f}, {0.36f, 0, 0}, {0, 0.16f, 0});
  for (Vertex& vertex : veil.vertices) vertex.color = {0.9f, 0.92f, 0.95f, vertex.position.y > -0.3f ? 0.0f : 0.9f};
  const int material = glb.addMaterial({.name = "veil", .alphaMode = AlphaMode::blend, .doubleSided = true});
  glb.add("veil", veil, material, {.colors = true});
}

Mesh opaqueContent() {
  Mesh content;
  for (int i = 0; i < 9; ++i) {
    const float x = -1.25f + 0.31f * static_cast<float>(i);
    const float z = i % 3 == 0 ? -2.52f : i % 3 == 1 ? -3.3f : -1.9f;
    const std::array<TubePoint, 2> rod = {TubePoint{{x, -0.62f, z}, 0.016f},
                                          TubePoint{{x, 0.5f - 0.07f * static_cast<float>(i % 4), z}, 0.016f}};
    const glm::vec4 color = i % 2 == 0 ? glm::vec4(0.9f, 0.88f, 0.82f, 1) : glm::vec4(0.12f, 0.13f, 0.15f, 1);
    append(content, colored(makeTube(rod, 12), color));
  }
  const auto ball = [](glm::vec3 center, float radius, glm::vec4 color) {
    return colored(
        transformed(makeSphere(14, 22), glm::scale(glm::translate(glm::mat4(1.0f), center), glm::vec3(radius))), color);
  };
  append(content, ball({-0.5f, -0.44f, -2.45f}, 0.18f, {0.9f, 0.9f, 0.88f, 1}));
  append(content, ball({0.42f, -0.40f, -3.2f}, 0.22f, {0.85f, 0.30f, 0.10f, 1}));
  append(content, ball({-0.20f, -0.53f, -1.75f}, 0.09f, {0.15f, 0.45f, 0.75f, 1}));
  return content;
}

}  // namespace

Scene makeGlassPanes() {
  Scene scene;
  Mesh solid = opaqueContent();
  addPanes(scene.glb, solid);
  bakeLight(solid);
  scene.glb.add("rods, balls, frames", solid, scene.glb.addMaterial({.name = "solid"}), {.colors = true});
  const int checker = scene.glb.addMaterial(
      {.name = "checker", .texture = scene.glb.addTexture("checker", paintChecker(), Wrap::repeat)});
  scene.glb.add("floor", makeRectangle({0, -0.62f, -3.25f}, {3.6f, 0, 0}, {0, 0, -2.45f}, {12.0f, 8.0f}), checker,
                {.uvs = true});
  const int wall =
      scene.glb.addMaterial({.name = "wall", .texture = scene.glb.addTexture("wall", paintWall(), Wrap::clamp)});
  scene.glb.add("wall", makeRectangle({0, 1.08f, -5.7f}, {3.7f, 0, 0}, {0, 1.7f, 0}), wall, {.uvs = true});

  Shot shot;
  shot.name = "glass_panes";
  shot.description = "alpha-blended panes at 1.0-1.7, 2.5 (focus, two intersecting) and 3.7-4.3 m over opaque content";
  shot.camera = {.position = {0, 0.1f, 0}, .target = {0, -0.03f, -kFocus}, .fovyDeg = 38.0f};
  shot.lens = {.apertureRadius = 0.045, .focusDistance = kFocus};
  shot.background = {0.1, 0.1, 0.12};
  scene.shots.push_back(shot);
  return scene;
}

}  // namespace scenes
