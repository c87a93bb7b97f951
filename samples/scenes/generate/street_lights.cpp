// A dark street with many small bright emitters: lamps, headlights, windows, and a string of bulbs near the
// lens. Radiance reaches 1e4, so blur must keep highlights round, and sums must keep their range.
#include <cmath>
#include <glm/common.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "generate/random.h"
#include "generate/scene.h"

namespace scenes {
namespace {

constexpr float kStreetHalfWidth = 4.5f;  // m
constexpr float kEye = 1.4f;              // m above the street

struct Facades {
  Canvas walls;
  Canvas windows;  ///< Emission: which windows are lit.
};

/// One tile of house front: 4 × 4 windows.
Facades paintFacades() {
  Facades facades{Canvas(128, 128), Canvas(128, 128, glm::vec4(0, 0, 0, 1))};
  facades.walls.paint([](glm::vec2 uv) {
    const float grain = 0.9f + 0.2f * std::round(tilingNoise(uv * 8.0f, 8, 3) * 6.0f) / 6.0f;
    return glm::vec4(glm::vec3(0.27f, 0.25f, 0.26f) * grain, 1.0f);
  });
  Random random(77);
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      const glm::ivec2 corner(column * 32 + 9, row * 32 + 7);
      facades.walls.fill(corner - 1, {16, 21}, {0.36f, 0.33f, 0.31f, 1});
      facades.walls.fill(corner, {14, 19}, {0.06f, 0.07f, 0.10f, 1});
      if (random.unit() > 0.4f) continue;
      const float warmth = random.between(0.55f, 1.0f);
      facades.windows.fill(corner, {6, 19}, {warmth, warmth * 0.85f, warmth * 0.6f, 1});
      facades.windows.fill(corner + glm::ivec2(8, 0), {6, 19}, {warmth, warmth * 0.85f, warmth * 0.6f, 1});
    }
  }
  return facades;
}

Canvas paintSign() {
  Canvas canvas(256, 80, glm::vec4(0.05f, 0.10f, 0.30f, 1));
  canvas.fill({5, 5}, {246, 70}, {0.85f, 0.86f, 0.84f, 1});
  canvas.fill({9, 9}, {238, 62}, {0.05f, 0.10f, 0.30f, 1});
  canvas.writeCentered("LENS STREET", {128, 25}, 3.5f, {0.92f, 0.92f, 0.9f, 1});
  return canvas;
}

void addStreet(Glb& glb) {
  const Facades facades = paintFacades();
  const int front = glb.addMaterial({.name = "facade",
                                     .baseColor = {0.35f, 0.35f, 0.4f, 1},
                                     .texture = glb.addTexture("facade", facades.walls, Wrap::repeat),
                                     .unlit = false,
                                     .emissive = {1.0f, 0.8f, 0.5f},
                                     .emissiveStrength = 3.0f,
                                     .emissiveTexture = glb.addTexture("windows", facades.windows, Wrap::repeat)});
  Mesh houses;
  Random random(12);
  for (int i = 0; i < 6; ++i) {
    for (const float side : {-1.0f, 1.0f}) {
      const float height = 4.0f + 1.5f * static_cast<float>(random.next() % 4);
      const float middle = -7.0f - 8.0f * static_cast<float>(i);
      const glm::vec3 center(side * (kStreetHalfWidth + 1.8f), height, middle);
      append(houses, makeRectangle(center, {0, 0, side * 4.0f}, {0, height, 0}, {1.0f, height / 4.0f}));
    }
  }
  append(houses, makeRectangle({0, 7, -51.0f}, {7.0f, 0, 0}, {0, 7, 0}, {1.75f, 1.75f}));
  glb.add("houses", houses, front, {.normals = true, .uvs = true});

  // Wet asphalt with pools of lamp light, painted into a grid of vertices.
  Mesh road = makeRectangle({0, 0, -26.0f}, {kStreetHalfWidth + 1.8f, 0, 0}, {0, 0, -26.0f}, glm::vec2(1), {24, 130});
  for (Vertex& vertex : road.vertices) {
    const float x = std::abs(vertex.position.x) - 4.3f;
    const float z = std::fmod(-vertex.position.z + 1.5f, 5.0f) - 2.5f;
    const float pool = std::exp(-(x * x + z * z) * 0.45f);
    const float streak =
        0.25f * std::exp(-x * x * 0.1f) * tilingNoise({vertex.position.x * 2.0f, vertex.position.z * 0.3f}, 64, 9);
    const bool kerb = std::abs(vertex.position.x) > kStreetHalfWidth;
    vertex.color = glm::vec4(glm::vec3(0.012f, 0.013f, 0.018f) * (kerb ? 1.8f : 1.0f) +
                                 glm::vec3(0.16f, 0.10f, 0.045f) * (pool + 0.2f * streak),
                             1);
  }
  glb.add("road", road, glb.addMaterial({.name = "asphalt", .unlit = false, .roughness = 0.5f}),
          {.normals = true, .colors = true});
}

/// One ball and many nodes for each kind of light.
class Bulbs {
 public:
  explicit Bulbs(Glb& glb) : glb_(glb), ball_(makeSphere(7, 12)) {}

  int kind(const std::string& name, glm::vec3 color, float strength) {
    const int material = glb_.addMaterial(
        {.name = name, .baseColor = {0, 0, 0, 1}, .unlit = false, .emissive = color, .emissiveStrength = strength});
    return glb_.addMesh(name, ball_, material, {.normals = true});
  }
  void place(const std::string& name, int kind, glm::vec3 center, float radius) {
    glb_.addNode(name, kind, {.translation = center, .scale = radius});
  }

 private:
  Glb& glb_;
  Mesh ball_;
};

void addLamps(Bulbs& bulbs, Mesh& metal) {
  const int sodium = bulbs.kind("sodium lamp", {1.0f, 0.55f, 0.16f}, 60.0f);
  for (int i = 0; i < 9; ++i) {
    const float z = -6.0f - 5.0f * static_cast<float>(i);
    for (const float side : {-1.0f, 1.0f}) {
      const float x = side * (kStreetHalfWidth + 0.2f);
      const std::array<TubePoint, 5> post = {TubePoint{{x, 0, z}, 0.07f},
                                             {{x, 1.0f, z}, 0.045f},
                                             {{x, 3.6f, z}, 0.04f},
                                             {{x - side * 0.25f, 4.0f, z}, 0.035f},
                                             {{x - side * 0.9f, 4.1f, z}, 0.03f}};
      append(metal, makeTube(post, 8));
      bulbs.place("lamp", sodium, {x - side * 0.9f, 3.98f, z}, 0.09f);
    }
  }
}

void addTraffic(Bulbs& bulbs, Mesh& metal) {
  const int head = bulbs.kind("headlight", {1.0f, 0.95f, 0.85f}, 1000.0f);
  const int tail = bulbs.kind("tail light", {1.0f, 0.05f, 0.03f}, 120.0f);
  const int beacon = bulbs.kind("beacon", {0.75f, 0.88f, 1.0f}, 10000.0f);
  const int green = bulbs.kind("green signal", {0.05f, 1.0f, 0.45f}, 80.0f);
  const int red = bulbs.kind("red signal", {1.0f, 0.06f, 0.04f}, 80.0f);
  const std::array<glm::vec2, 6> cars = {glm::vec2(-1.9f, -11), {-2.1f, -19}, {-1.8f, -30},
                                         {1.9f, -8.5f},         {2.0f, -16},  {1.8f, -27}};
  for (const glm::vec2 car : cars) {
    const bool oncoming = car.x < 0.0f;
    append(metal, makeBox({car.x, 0.55f, car.y - 1.5f}, {0.85f, 0.35f, 1.4f}));
    append(metal, makeBox({car.x, 1.1f, car.y - 1.7f}, {0.7f, 0.22f, 0.8f}));
    for (const float side : {-0.62f, 0.62f}) {
      const glm::vec3 at(car.x + side, 0.62f, car.y - 0.06f);
      bulbs.place("car light", oncoming ? head : tail, at, oncoming ? 0.055f : 0.075f);
    }
  }
  for (const float x : {-3.6f, 3.6f}) {
    append(metal, makeBox({x, 2.4f, -13.0f}, {0.11f, 0.3f, 0.08f}));
    append(metal, makeBox({x, 1.05f, -13.0f}, {0.03f, 1.05f, 0.03f}));
    bulbs.place("signal", x < 0.0f ? green : red, {x, x < 0.0f ? 2.25f : 2.55f, -12.92f}, 0.075f);
  }
  bulbs.place("beacon", beacon, {0.6f, 8.2f, -44.0f}, 0.035f);
  bulbs.place("beacon", beacon, {-1.7f, 6.4f, -38.0f}, 0.022f);
}

/// A cord with coloured bulbs that hangs close to the lens.
void addString(Bulbs& bulbs, Mesh& metal) {
  const std::array<int, 4> kinds = {
      bulbs.kind("warm bulb", {1.0f, 0.7f, 0.3f}, 40.0f), bulbs.kind("rose bulb", {1.0f, 0.15f, 0.35f}, 50.0f),
      bulbs.kind("blue bulb", {0.15f, 0.4f, 1.0f}, 50.0f), bulbs.kind("mint bulb", {0.2f, 1.0f, 0.6f}, 40.0f)};
  std::vector<TubePoint> cord;
  for (int i = 0; i <= 26; ++i) {
    const float t = static_cast<float>(i) / 26.0f * 2.0f - 1.0f;
    const glm::vec3 at(t * 0.95f, kEye + 0.12f + 0.2f * t * t + 0.03f * t, -1.0f - 0.12f * t);
    cord.push_back({at, 0.0025f});
    if (i % 2 == 0) continue;
    bulbs.place("bulb", kinds[static_cast<size_t>(i / 2) % kinds.size()], at - glm::vec3(0, 0.018f, 0), 0.006f);
  }
  append(metal, makeTube(cord, 6));
}

}  // namespace

Scene makeStreetLights() {
  Scene scene;
  addStreet(scene.glb);
  Bulbs bulbs(scene.glb);
  Mesh metal;
  addLamps(bulbs, metal);
  addTraffic(bulbs, metal);
  addString(bulbs, metal);
  // What is in focus: a street sign at two metres.
  const std::array<TubePoint, 2> post = {TubePoint{{-0.52f, 0, -2.0f}, 0.028f},
                                         TubePoint{{-0.52f, 1.72f, -2.0f}, 0.028f}};
  append(metal, makeTube(post, 14));
  metal = colored(metal, {0.05f, 0.05f, 0.06f, 1});
  bakeLight(metal, {.towardsSun = {0.5f, 0.7f, 0.6f}, .sun = {0.9f, 0.6f, 0.35f}});
  scene.glb.add("posts, cars, cord", metal, scene.glb.addMaterial({.name = "metal", .unlit = false, .roughness = 0.6f}),
                {.normals = true, .colors = true});
  const int sign = scene.glb.addMaterial({.name = "sign",
                                          .baseColor = {0.6f, 0.55f, 0.5f, 1},
                                          .texture = scene.glb.addTexture("sign", paintSign(), Wrap::clamp),
                                          .doubleSided = true,
                                          .unlit = false});
  scene.glb.add("sign", makeRectangle({-0.38f, 1.52f, -1.965f}, {0.32f, 0, 0}, {0, 0.1f, 0}), sign,
                {.normals = true, .uvs = true});

  Shot shot;
  shot.name = "street_lights";
  shot.description = "emitters of radiance 40 to 10000 before and behind a street sign in focus at 2 m, night";
  shot.camera = {.position = {0, kEye, 0}, .target = {0, 1.55f, -10.0f}, .fovyDeg = 40.0f};
  shot.lens = {.apertureRadius = 0.045, .focusDistance = 1.97};
  shot.background = {0.004, 0.006, 0.014};
  scene.shots.push_back(shot);
  return scene;
}

}  // namespace scenes
