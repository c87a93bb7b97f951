// A wrought railing close to the lens before a wall with lettering of many sizes (after Selgrad 2015, fig.
// 1): focused far the railing must dissolve and the text behind it stay readable; focused near the wall
// dissolves.
#include <cmath>
#include <glm/common.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <string_view>

#include "generate/scene.h"

namespace scenes {
namespace {

constexpr float kWallDepth = 4.0f;      // m
constexpr float kRailingDepth = 0.68f;  // m at its middle; it is turned, so its ends differ.

Canvas paintBricks() {
  Canvas canvas(128, 128);
  canvas.paint([](glm::vec2 uv) {
    constexpr float kRows = 6.0f;
    constexpr float kColumns = 2.0f;
    const float row = std::floor(uv.y * kRows);
    const float column = uv.x * kColumns + (std::fmod(row, 2.0f) < 0.5f ? 0.0f : 0.5f);
    const float x = column - std::floor(column);
    const float y = uv.y * kRows - row;
    const bool mortar = x < 0.035f || x > 0.965f || y < 0.09f || y > 0.91f;
    const float grain = tilingClouds(uv * 16.0f, 16, 7, 2);
    const float wrapped = std::fmod(std::floor(column), kColumns);
    const float tint = tilingNoise({row * 3.0f + 0.5f, wrapped * 5.0f + 0.5f}, 64, 11);
    const glm::vec3 brick = glm::mix(glm::vec3(0.55f, 0.27f, 0.20f), glm::vec3(0.70f, 0.40f, 0.29f), tint);
    const glm::vec3 color = mortar ? glm::vec3(0.62f, 0.59f, 0.54f) : brick;
    // Few grey levels keep the texture small.
    return glm::vec4(color * (0.88f + 0.24f * std::round(grain * 8.0f) / 8.0f), 1.0f);
  });
  return canvas;
}

Canvas paintPoster() {
  const glm::vec4 paper(0.93f, 0.90f, 0.82f, 1.0f);
  const glm::vec4 ink(0.10f, 0.11f, 0.14f, 1.0f);
  const glm::vec4 red(0.70f, 0.13f, 0.10f, 1.0f);
  Canvas canvas(1280, 800, paper);
  canvas.fill({0, 0}, {1280, 150}, red);
  canvas.fill({24, 780}, {1232, 6}, red);
  canvas.writeCentered("LENSGRAPH", {640, 26}, 14.0f, paper);
  struct Line {
    std::string_view text;
    float dot;
    float top;
  };
  for (const Line& line :
       {Line{"CIRCLES OF CONFUSION", 9.0f, 186}, Line{"NEAR, SHARP AND FAR AGAIN", 7.5f, 274},
        Line{"THE QUICK BROWN FOX JUMPS", 6.0f, 352}, Line{"OVER THE LAZY DOG 0123456789", 6.0f, 410},
        Line{"WHAT STANDS BEHIND THE BARS IS NOT LOST:", 5.0f, 478},
        Line{"A WIDE LENS LOOKS AROUND THEM FROM BOTH SIDES", 4.4f, 532},
        Line{"AND EVERY LETTER OF THIS WALL CAN STILL BE READ.", 4.0f, 582},
        Line{"SMALL PRINT: F 1.4 F 2 F 2.8 F 4 F 5.6 F 8 F 11 F 16 F 22 F 32", 3.2f, 634},
        Line{"SMALLER PRINT: ABCDEFGHIJKLMNOPQRSTUVWXYZ & 0123456789 ABCDEFGH", 2.8f, 680}}) {
    canvas.writeCentered(line.text, {640, line.top}, line.dot, ink);
  }
  for (int i = 0; i < 96; ++i) {  // A resolution wedge: bars of 1 to 6 px.
    const int width = 1 + i / 16;
    canvas.fill({40 + (i % 16) * width * 2 + (width - 1) * width * 16 + (width - 1) * 50, 726}, {width, 40}, ink);
  }
  return canvas;
}

Mesh balustrade(Mesh& knobs) {
  Mesh iron;
  for (int i = -9; i <= 9; ++i) {
    const float x = static_cast<float>(i) * 0.095f;
    const std::array<TubePoint, 2> bar = {TubePoint{{x, -0.42f, 0.0f}, 0.0065f}, TubePoint{{x, 0.15f, 0.0f}, 0.0065f}};
    append(iron, makeTube(bar, 10));
    const glm::mat4 place = glm::translate(glm::mat4(1.0f), {x, i % 2 == 0 ? -0.02f : 0.06f, 0.0f});
    append(knobs, transformed(makeSphere(8, 14), glm::scale(place, glm::vec3(0.0125f, 0.017f, 0.0125f))));
    if (i < 9) {
      const glm::mat4 ring = glm::translate(glm::mat4(1.0f), {x + 0.0475f, -0.135f, 0.0f});
      append(iron, transformed(makeTorus(0.040f, 0.0045f, 28, 8), ring));
    }
  }
  append(iron, makeBox({0.0f, -0.182f, 0.0f}, {0.92f, 0.007f, 0.008f}));
  append(iron, makeBox({0.0f, -0.088f, 0.0f}, {0.92f, 0.007f, 0.008f}));
  append(iron, makeBox({0.0f, 0.158f, 0.0f}, {0.92f, 0.014f, 0.018f}));
  return iron;
}

void addSurroundings(Glb& glb) {
  const int bricks =
      glb.addMaterial({.name = "bricks", .texture = glb.addTexture("bricks", paintBricks(), Wrap::repeat)});
  const int poster =
      glb.addMaterial({.name = "poster", .texture = glb.addTexture("poster", paintPoster(), Wrap::clamp)});
  const int stone = glb.addMaterial({.name = "stone"});
  const Mesh wall = makeRectangle({0.0f, 1.5f, -kWallDepth}, {3.6f, 0, 0}, {0, 1.8f, 0}, {9.0f, 6.0f});
  glb.add("wall", wall, bricks, {.uvs = true});
  const Mesh sheet = makeRectangle({0.0f, 1.56f, -kWallDepth + 0.02f}, {1.76f, 0, 0}, {0, 1.1f, 0});
  glb.add("poster", sheet, poster, {.uvs = true});

  Mesh ground;
  for (int row = 0; row < 5; ++row) {
    for (int column = -5; column < 5; ++column) {
      const float shade = 0.32f + 0.10f * static_cast<float>((row * 7 + column * column * 3) % 4);
      const glm::vec3 center(0.5f + static_cast<float>(column) * 0.9f, 0.06f, -3.6f + static_cast<float>(row) * 0.9f);
      append(ground, colored(makeRectangle(center, {0.44f, 0, 0}, {0, 0, -0.44f}), {shade, shade, shade * 0.95f, 1}));
    }
  }
  append(ground, colored(makeRectangle({0, 0.05f, -1.8f}, {4.6f, 0, 0}, {0, 0, -2.25f}), {0.10f, 0.10f, 0.10f, 1}));
  const std::array<glm::vec2, 8> pot = {glm::vec2(0.0f, 0.0f), {0.16f, 0.0f},  {0.19f, 0.10f}, {0.25f, 0.38f},
                                        {0.28f, 0.40f},        {0.28f, 0.46f}, {0.22f, 0.46f}, {0.20f, 0.34f}};
  const std::array<glm::vec3, 2> places = {glm::vec3(-1.45f, 0.06f, -3.1f), glm::vec3(1.15f, 0.06f, -2.5f)};
  for (const glm::vec3 place : places) {
    const glm::mat4 matrix = glm::translate(glm::mat4(1.0f), place);
    Mesh planter = colored(transformed(makeLathe(pot, 28), matrix), {0.75f, 0.35f, 0.18f, 1});
    append(planter,
           colored(transformed(makeSphere(12, 18), glm::scale(glm::translate(matrix, {0, 0.56f, 0}), glm::vec3(0.26f))),
                   {0.16f, 0.42f, 0.12f, 1}));
    bakeLight(planter);
    append(ground, planter);
  }
  glb.add("ground", ground, stone, {.colors = true});
}

}  // namespace

Scene makeRailingText() {
  Scene scene;
  addSurroundings(scene.glb);
  Mesh brass;
  Mesh iron = colored(balustrade(brass), {0.035f, 0.05f, 0.055f, 1});
  append(iron, colored(brass, {0.85f, 0.55f, 0.12f, 1}));
  const glm::mat4 turned = glm::rotate(glm::translate(glm::mat4(1.0f), {0.0f, 1.52f, -kRailingDepth}),
                                       glm::radians(14.0f), glm::vec3(0, 1, 0));
  iron = transformed(iron, turned);
  bakeLight(iron);
  scene.glb.add("railing", iron, scene.glb.addMaterial({.name = "iron"}), {.colors = true});

  Shot shot;
  shot.camera = {.position = {0.0f, 1.52f, 0.0f}, .target = {0.0f, 1.47f, -kWallDepth}, .fovyDeg = 40.0f};
  shot.background = {0.35, 0.5, 0.7};
  shot.name = "railing_text_far";
  shot.description = "railing at 0.6-0.9 m out of focus before lettering in focus at 4 m";
  shot.lens = {.apertureRadius = 0.026, .focusDistance = 3.98};
  scene.shots.push_back(shot);
  shot.name = "railing_text_near";
  shot.description = "railing in focus at 0.68 m, lettering at 4 m out of focus";
  shot.lens.focusDistance = 0.68;
  scene.shots.push_back(shot);
  return scene;
}

}  // namespace scenes
