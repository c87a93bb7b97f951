// See furniture.h.
#include "parts/furniture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "parts/shapes.h"

namespace scenes {
namespace {

glm::mat4 shifted(glm::vec3 by) {
  return glm::translate(glm::mat4(1.0f), by);
}

/// Six bars, a floor and a roof about a globe; standing on y = 0.
void addLantern(Mesh& metal, Mesh& globe, float y, float size) {
  const std::array<glm::vec2, 5> foot = {
      glm::vec2(0.0f, 0.0f), {0.22f, 0.0f}, {0.30f, 0.05f}, {0.30f, 0.10f}, {0.0f, 0.10f}};
  const std::array<glm::vec2, 9> roof = {glm::vec2(0.0f, 0.80f), {0.42f, 0.80f}, {0.44f, 0.84f},
                                         {0.30f, 0.95f},         {0.14f, 1.05f}, {0.08f, 1.12f},
                                         {0.10f, 1.17f},         {0.04f, 1.22f}, {0.0f, 1.32f}};
  const glm::mat4 place = glm::scale(shifted({0, y, 0}), glm::vec3(size));
  append(metal, transformed(makeLathe(foot, 24), place));
  append(metal, transformed(makeLathe(roof, 24), place));
  for (int i = 0; i < 6; ++i) {
    const float angle = glm::two_pi<float>() * static_cast<float>(i) / 6.0f;
    const glm::vec3 out(std::sin(angle), 0, std::cos(angle));
    const std::array<TubePoint, 2> bar = {TubePoint{out * 0.27f + glm::vec3(0, 0.08f, 0), 0.02f},
                                          TubePoint{out * 0.39f + glm::vec3(0, 0.82f, 0), 0.02f}};
    append(metal, transformed(makeTube(bar, 8), place));
  }
  const glm::mat4 ball = glm::scale(shifted({0, y + 0.42f * size, 0}), glm::vec3(0.15f, 0.2f, 0.15f) * size);
  append(globe, transformed(makeSphere(16, 20), ball));
}

}  // namespace

StreetLamp makeStreetLamp() {
  StreetLamp lamp;
  std::vector<glm::vec2> post = {{0.0f, 0.0f},   {0.20f, 0.0f},   {0.20f, 0.08f}, {0.17f, 0.11f},
                                 {0.16f, 0.35f}, {0.18f, 0.38f},  {0.18f, 0.42f}, {0.11f, 0.48f},
                                 {0.07f, 0.62f}, {0.085f, 0.68f}, {0.06f, 0.74f}};
  for (int i = 0; i < 6; ++i) {
    const float y = 0.8f + 0.34f * static_cast<float>(i);
    post.emplace_back(0.055f - 0.003f * static_cast<float>(i), y);
  }
  for (const glm::vec2 end : {glm::vec2(0.06f, 2.62f),
                              {0.075f, 2.68f},
                              {0.04f, 2.76f},
                              {0.04f, 2.9f},
                              {0.09f, 2.94f},
                              {0.09f, 2.97f},
                              {0.0f, 2.97f}}) {
    post.push_back(end);
  }
  lamp.metal = makeLathe(post, 20);
  for (const float side : {-1.0f, 1.0f}) {
    const std::array<TubePoint, 2> arm = {TubePoint{{side * 0.02f, 2.55f, 0}, 0.018f},
                                          TubePoint{{side * 0.38f, 2.55f, 0}, 0.012f}};
    append(lamp.metal, makeTube(arm, 8));
  }
  addLantern(lamp.metal, lamp.globe, 2.96f, 0.5f);
  scaleUv(lamp.metal, {2.0f, 4.0f});
  lamp.light = {0, 3.17f, 0};
  return lamp;
}

StreetLamp makeTableLantern() {
  StreetLamp lamp;
  addLantern(lamp.metal, lamp.globe, 0.0f, 0.26f);
  append(lamp.metal, transformed(makeTorus(0.05f, 0.005f, 32, 10), shifted({0, 0.39f, 0})));
  lamp.light = {0, 0.11f, 0};
  return lamp;
}

Board makeBoard(float width, float height) {
  Board board;
  constexpr float kEdge = 0.05f, kThick = 0.022f;
  const float x = width * 0.5f;
  const auto bar = [&board](glm::vec3 low, glm::vec3 high) { append(board.frame, boxBetween(low, high)); };
  bar({-x, 0.0f, -kThick}, {-x + kEdge, height, kThick});
  bar({x - kEdge, 0.0f, -kThick}, {x, height, kThick});
  bar({-x + kEdge, height - kEdge, -kThick}, {x - kEdge, height, kThick});
  bar({-x + kEdge, 0.16f, -kThick}, {x - kEdge, 0.16f + kEdge, kThick});
  bar({-x + kEdge, 0.21f, -0.012f}, {x - kEdge, height - kEdge, 0.0f});
  mapPlanar(board.frame, 0.6f);
  board.face = makeRectangle({0, (0.21f + height - kEdge) * 0.5f, 0.004f}, {x - kEdge, 0, 0},
                             {0, (height - kEdge - 0.21f) * 0.5f, 0});
  const glm::mat4 lean = glm::rotate(shifted({0, 0, 0.16f}), -0.16f, glm::vec3(1, 0, 0));
  board.frame = transformed(board.frame, lean);
  board.face = transformed(board.face, lean);
  Mesh legs;
  append(legs, boxBetween({-x, 0.0f, -kThick}, {-x + kEdge, height - 0.03f, kThick}));
  append(legs, boxBetween({x - kEdge, 0.0f, -kThick}, {x, height - 0.03f, kThick}));
  mapPlanar(legs, 0.6f);
  append(board.frame, transformed(legs, glm::rotate(shifted({0, 0, -0.24f}), 0.17f, glm::vec3(1, 0, 0))));
  return board;
}

Canvas paintMenu() {
  Canvas canvas(384, 512);
  canvas.paint([](glm::vec2 p) {
    const float dust = tilingClouds(p * 6.0f, 6, 71, 5);
    return glm::vec4(glm::vec3(0.13f, 0.15f, 0.15f) + 0.16f * dust * dust, 1.0f);
  });
  const glm::vec4 chalk(0.93f, 0.92f, 0.88f, 1), yellow(0.95f, 0.80f, 0.40f, 1), rose(0.93f, 0.55f, 0.50f, 1);
  canvas.writeCentered("LENS", {192, 34}, 9.0f, yellow);
  canvas.writeCentered("CAFE", {192, 112}, 9.0f, yellow);
  canvas.fill({48, 192}, {288, 3}, chalk);
  canvas.writeCentered("SOUP OF THE DAY", {192, 214}, 3.2f, chalk);
  canvas.writeCentered("FRESH BREAD", {192, 254}, 3.2f, chalk);
  canvas.writeCentered("COFFEE & CAKE", {192, 294}, 3.2f, chalk);
  canvas.writeCentered("F/1.4 - F/16", {192, 334}, 3.2f, rose);
  canvas.fill({48, 376}, {288, 3}, chalk);
  canvas.writeCentered("OPEN", {192, 402}, 8.0f, chalk);
  canvas.writeCentered("TILL LATE", {192, 472}, 2.4f, chalk);
  return canvas;
}

HangingSign makeHangingSign() {
  HangingSign sign;
  const std::array<TubePoint, 2> arm = {TubePoint{{0, 0, 0}, 0.016f}, TubePoint{{0.95f, 0, 0}, 0.012f}};
  append(sign.iron, makeTube(arm, 10));
  std::vector<TubePoint> scroll;
  for (int i = 0; i <= 40; ++i) {
    const float t = static_cast<float>(i) / 40.0f;
    const float angle = -1.2f + t * 9.0f;
    const float radius = 0.22f * (1.0f - 0.85f * t);
    scroll.push_back({{0.3f + radius * std::cos(angle), 0.22f + radius * std::sin(angle), 0}, 0.009f});
  }
  append(sign.iron, makeTube(scroll, 8));
  for (const float x : {0.25f, 0.85f}) {
    for (int link = 0; link < 4; ++link) {
      const glm::mat4 at = glm::rotate(shifted({x, -0.02f - 0.03f * static_cast<float>(link), 0}),
                                       link % 2 == 0 ? 0.0f : glm::half_pi<float>(), glm::vec3(0, 1, 0));
      append(sign.iron, transformed(makeTorus(0.019f, 0.004f, 16, 8), at));
    }
  }
  append(sign.iron, boxBetween({0.12f, -0.68f, -0.018f}, {0.98f, -0.13f, 0.018f}));
  sign.faces = makeRectangle({0.55f, -0.405f, 0.022f}, {0.41f, 0, 0}, {0, 0.255f, 0});
  append(sign.faces, makeRectangle({0.55f, -0.405f, -0.022f}, {-0.41f, 0, 0}, {0, 0.255f, 0}));
  return sign;
}

Canvas paintSign(const std::string& upper, const std::string& lower, glm::vec3 ground) {
  Canvas canvas(256, 160);
  canvas.paint(
      [&](glm::vec2 p) { return glm::vec4(ground * (0.85f + 0.3f * tilingClouds(p * 8.0f, 8, 13, 4)), 1.0f); });
  const glm::vec4 gold(0.90f, 0.76f, 0.42f, 1);
  const glm::vec4 back(ground, 1);
  canvas.fill({8, 8}, {240, 144}, gold);
  canvas.fill({12, 12}, {232, 136}, back);
  const auto line = [&](const std::string& text, float middle) {
    constexpr float kWidth = 212.0f, kLargestDot = 5.5f;  // px
    const float dot = std::min(kLargestDot, kWidth / (6.0f * static_cast<float>(text.size()) - 1.0f));
    canvas.writeCentered(text, {128, middle - 3.5f * dot}, dot, gold);
  };
  line(upper, 50.0f);
  line(lower, 110.0f);
  return canvas;
}

Mesh makePot(float height) {
  const std::array<glm::vec2, 12> shape = {glm::vec2(0.0f, 0.0f), {0.30f, 0.0f},  {0.33f, 0.04f}, {0.42f, 0.70f},
                                           {0.43f, 0.78f},        {0.49f, 0.80f}, {0.50f, 0.98f}, {0.48f, 1.0f},
                                           {0.44f, 1.0f},         {0.42f, 0.93f}, {0.41f, 0.88f}, {0.0f, 0.88f}};
  std::vector<glm::vec2> profile;
  for (const glm::vec2 point : shape) profile.push_back(point * height);
  Mesh pot = makeLathe(profile, 40);
  scaleUv(pot, {2.0f, 1.0f});
  return pot;
}

Mesh makeCrate(glm::vec3 halfSize) {
  Mesh crate;
  constexpr int kSlats = 4;
  const float height = 2.0f * halfSize.y;
  for (int i = 0; i < kSlats; ++i) {
    const float low = height * (static_cast<float>(i) + 0.06f) / kSlats;
    const float high = height * (static_cast<float>(i) + 0.9f) / kSlats;
    for (const float side : {-1.0f, 1.0f}) {
      append(crate, makeBox({0, (low + high) * 0.5f, side * halfSize.z}, {halfSize.x, (high - low) * 0.5f, 0.009f}));
      append(crate,
             makeBox({side * halfSize.x, (low + high) * 0.5f, 0}, {0.009f, (high - low) * 0.5f, halfSize.z - 0.01f}));
    }
  }
  for (const float x : {-1.0f, 1.0f}) {
    for (const float z : {-1.0f, 1.0f}) {
      append(crate, boxBetween({x * (halfSize.x - 0.03f) - 0.02f, 0.0f, z * (halfSize.z - 0.03f) - 0.018f},
                               {x * (halfSize.x - 0.03f) + 0.02f, height, z * (halfSize.z - 0.03f) + 0.018f}));
    }
  }
  append(crate, makeBox({0, height + 0.01f, 0}, {halfSize.x + 0.02f, 0.009f, halfSize.z + 0.02f}));
  mapPlanar(crate, 0.6f);
  return crate;
}

Mesh makeAwning(float width) {
  constexpr int kAcross = 96, kDown = 14;
  Mesh mesh = makeRectangle(glm::vec3(0.0f), {1, 0, 0}, {0, 1, 0}, glm::vec2(1.0f), {kAcross, kDown});
  for (Vertex& vertex : mesh.vertices) {
    const float t = 0.5f - 0.5f * vertex.position.y;  // 0 at the wall
    const float u = vertex.position.x * 0.5f + 0.5f;
    const float slope = std::min(t / 0.82f, 1.0f);
    const float hang = std::max(0.0f, (t - 0.82f) / 0.18f);
    const float scallop = 0.13f + 0.05f * std::abs(std::sin(u * glm::pi<float>() * 8.0f));
    const float sag = 0.04f * std::sin(slope * glm::pi<float>()) + 0.012f * std::sin(u * 40.0f) * slope;
    vertex.position = {(u - 0.5f) * width, -0.55f * slope - sag - hang * scallop, 0.03f + 1.05f * slope};
    vertex.uv = {u * width / 0.4f, t};
  }
  smoothNormals(mesh);
  return mesh;
}

LightString makeLightString(glm::vec3 from, glm::vec3 to, float sag, int bulbs) {
  LightString string;
  std::vector<TubePoint> cord;
  const int segments = bulbs * 3;
  for (int i = 0; i <= segments; ++i) {
    const float t = static_cast<float>(i) / static_cast<float>(segments);
    const glm::vec3 at = glm::mix(from, to, t) - glm::vec3(0, sag * 4.0f * t * (1.0f - t), 0);
    cord.push_back({at, 0.008f});
    if (i % 3 == 1) string.bulbs.push_back(at - glm::vec3(0, 0.07f, 0));
  }
  string.cord = makeTube(cord, 5);
  return string;
}

Mesh makeCobblePatch(glm::vec2 corner, const std::function<float(glm::vec2)>& lightAt, Random& random) {
  Mesh patch;
  constexpr int kStones = 8;
  constexpr float kPitch = 1.0f / kStones;
  for (int row = 0; row < kStones; ++row) {
    for (int column = 0; column < kStones; ++column) {
      // Every second row is shifted by half a stone, half out of the patch, where its neighbor has the gap.
      const float x = corner.x + (static_cast<float>(column) + (row % 2 == 0 ? 0.25f : 0.75f)) * kPitch;
      const float z = corner.y - (static_cast<float>(row) + 0.5f) * kPitch;
      const glm::vec3 half(kPitch * random.between(0.46f, 0.5f), random.between(0.010f, 0.018f),
                           kPitch * random.between(0.46f, 0.5f));
      Mesh stone = transformed(makeStone(random, half, 0.03f, 4), shifted({x, random.between(-0.004f, 0.004f), z}));
      const glm::vec3 tone =
          random.between(0.6f, 1.0f) * glm::vec3(1.0f, random.between(0.94f, 1.0f), random.between(0.86f, 1.0f));
      const glm::vec2 shift(random.unit(), random.unit());
      for (Vertex& vertex : stone.vertices) {
        vertex.color = glm::vec4(tone * lightAt({vertex.position.x, vertex.position.z}), 1.0f);
        vertex.uv = vertex.uv * 0.3f + shift;
      }
      append(patch, stone);
    }
  }
  return patch;
}

}  // namespace scenes
