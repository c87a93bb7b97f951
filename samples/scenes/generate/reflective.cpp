// Glossy metal and glaze under a studio of small bright lamps: what a surface shows changes with the point of
// the lens it is seen from, so a technique that stores one colour per surface point is visibly wrong here.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "generate/scene.h"

namespace scenes {
namespace {

const glm::vec3 kGold(1.0f, 0.71f, 0.29f);
const glm::vec3 kCopper(0.95f, 0.64f, 0.54f);
const glm::vec3 kSilver(0.95f, 0.94f, 0.92f);

int addSurface(Glb& glb, const std::string& name, glm::vec3 color, float metallic, float roughness) {
  return glb.addMaterial(
      {.name = name, .baseColor = glm::vec4(color, 1), .unlit = false, .metallic = metallic, .roughness = roughness});
}

/// Body and lid turned on a lathe, spout and handle as tubes. About 0.36 m wide, standing on y = 0.
Mesh makeTeapot() {
  const std::array<glm::vec2, 22> profile = {
      glm::vec2(0.0f, 0.0f), {0.075f, 0.0f},   {0.080f, 0.006f}, {0.079f, 0.012f}, {0.098f, 0.035f}, {0.116f, 0.062f},
      {0.124f, 0.090f},      {0.122f, 0.116f}, {0.110f, 0.140f}, {0.094f, 0.157f}, {0.083f, 0.164f}, {0.083f, 0.170f},
      {0.078f, 0.174f},      {0.055f, 0.184f}, {0.030f, 0.191f}, {0.015f, 0.195f}, {0.012f, 0.203f}, {0.019f, 0.212f},
      {0.021f, 0.221f},      {0.016f, 0.229f}, {0.008f, 0.233f}, {0.0f, 0.234f}};
  Mesh pot = makeLathe(profile, 40);
  std::vector<TubePoint> spout;
  std::vector<TubePoint> handle;
  for (int i = 0; i <= 12; ++i) {
    const float t = static_cast<float>(i) / 12.0f;
    spout.push_back({{0.10f + 0.11f * t, 0.055f + 0.115f * t + 0.02f * std::sin(t * 5.0f), 0.0f}, 0.026f - 0.014f * t});
    const float angle = glm::pi<float>() * (0.42f + 1.13f * t);
    handle.push_back({{-0.118f + 0.078f * std::cos(angle), 0.098f + 0.058f * std::sin(angle), 0.0f}, 0.0095f});
  }
  append(pot, makeTube(spout, 16));
  append(pot, makeTube(handle, 12));
  return pot;
}

Mesh makeGoblet() {
  const std::array<glm::vec2, 15> profile = {glm::vec2(0.0f, 0.0f), {0.06f, 0.0f},   {0.06f, 0.006f},  {0.02f, 0.018f},
                                             {0.011f, 0.04f},       {0.010f, 0.10f}, {0.016f, 0.118f}, {0.045f, 0.14f},
                                             {0.066f, 0.18f},       {0.070f, 0.22f}, {0.064f, 0.26f},  {0.060f, 0.26f},
                                             {0.066f, 0.22f},       {0.058f, 0.17f}, {0.0f, 0.145f}};
  return makeLathe(profile, 36);
}

Canvas paintTable() {
  Canvas canvas(64, 64);
  canvas.paint([](glm::vec2 uv) {
    const bool light = (uv.x < 0.5f) == (uv.y < 0.5f);
    const glm::vec3 color = light ? glm::vec3(0.80f, 0.77f, 0.70f) : glm::vec3(0.30f, 0.33f, 0.38f);
    return glm::vec4(color, 1.0f);
  });
  return canvas;
}

void addTable(Glb& glb) {
  const int table = glb.addMaterial({.name = "table",
                                     .texture = glb.addTexture("table", paintTable(), Wrap::repeat),
                                     .unlit = false,
                                     .roughness = 0.35f});
  const Mesh top = makeRectangle({0, 0, -1.2f}, {3.2f, 0, 0}, {0, 0, -2.6f}, {16, 13});
  glb.add("table", top, table, {.normals = true, .uvs = true});
}

void addObjects(Glb& glb) {
  const int chrome = addSurface(glb, "chrome", kSilver, 1.0f, 0.06f);
  const int gold = addSurface(glb, "gold", kGold, 1.0f, 0.14f);
  const int copper = addSurface(glb, "copper", kCopper, 1.0f, 0.22f);
  const int glaze = addSurface(glb, "red glaze", {0.45f, 0.02f, 0.02f}, 0.0f, 0.05f);
  const int jade = addSurface(glb, "jade glaze", {0.05f, 0.25f, 0.16f}, 0.0f, 0.10f);
  constexpr Attributes kLit{.normals = true};
  const Mesh sphere = makeSphere(32, 48);
  const int chromeBall = glb.addMesh("chrome ball", sphere, chrome, kLit);
  const int goldBall = glb.addMesh("gold ball", sphere, gold, kLit);
  const int glazeBall = glb.addMesh("glaze ball", sphere, glaze, kLit);
  const int jadeBall = glb.addMesh("jade ball", sphere, jade, kLit);
  const int teapot = glb.addMesh("teapot", makeTeapot(), copper, kLit);
  const int goblet = glb.addMesh("goblet", makeGoblet(), gold, kLit);
  const int ring = glb.addMesh("ring", makeTorus(0.11f, 0.03f, 48, 20), chrome, kLit);
  const auto ball = [&glb](int mesh, glm::vec2 at, float radius) {
    glb.addNode("ball", mesh, {.translation = {at.x, radius, at.y}, .scale = radius});
  };
  const auto turned = [](float yaw) { return glm::angleAxis(yaw, glm::vec3(0, 1, 0)); };
  ball(chromeBall, {-0.36f, 0.86f}, 0.13f);  // near
  ball(goldBall, {0.36f, 0.98f}, 0.085f);
  ball(glazeBall, {0.08f, 0.80f}, 0.06f);
  glb.addNode("teapot", teapot,
              {.translation = {0.02f, 0, 0.0f}, .rotation = turned(-0.35f), .scale = 1.5f});  // in focus
  ball(jadeBall, {-0.48f, 0.02f}, 0.11f);
  ball(chromeBall, {0.50f, -0.05f}, 0.13f);
  glb.addNode("goblet", goblet, {.translation = {0.30f, 0, 0.22f}, .scale = 0.9f});
  ball(goldBall, {-0.85f, -1.1f}, 0.26f);  // far
  ball(glazeBall, {0.25f, -1.5f}, 0.24f);
  ball(chromeBall, {1.25f, -1.6f}, 0.34f);
  ball(chromeBall, {-1.9f, -2.8f}, 0.40f);
  glb.addNode("ring", ring, {.translation = {-0.28f, 0.27f, -0.9f}, .rotation = turned(0.5f), .scale = 1.9f});
  glb.addNode("goblet", goblet, {.translation = {0.78f, 0, -0.85f}, .scale = 1.7f});
}

/// Angular box of radiance: softly edged lamp around a direction.
glm::vec3 lamp(glm::vec3 direction, glm::vec3 towards, glm::vec2 halfSize, glm::vec3 radiance) {
  towards = glm::normalize(towards);
  const glm::vec3 right = glm::normalize(glm::cross(glm::vec3(0, 1, 0), towards));
  const glm::vec3 up = glm::cross(towards, right);
  const float ahead = glm::dot(direction, towards);
  if (ahead <= 0.0f) return glm::vec3(0.0f);
  const glm::vec2 at = glm::abs(glm::vec2(glm::dot(direction, right), glm::dot(direction, up)) / ahead) - halfSize;
  constexpr float kEdge = 0.03f;  // About half a texel.
  return radiance * glm::clamp(0.5f - at.x / kEdge, 0.0f, 1.0f) * glm::clamp(0.5f - at.y / kEdge, 0.0f, 1.0f);
}

glm::vec3 studioRadiance(glm::vec3 direction) {
  const float upward = direction.y;
  glm::vec3 radiance =
      upward > 0.0f ? glm::mix(glm::vec3(0.42f, 0.38f, 0.36f), glm::vec3(0.06f, 0.08f, 0.14f), std::sqrt(upward))
                    : glm::mix(glm::vec3(0.30f, 0.24f, 0.18f), glm::vec3(0.05f, 0.04f, 0.03f), std::sqrt(-upward));
  radiance += lamp(direction, {-0.8f, 0.75f, 0.9f}, {0.30f, 0.22f}, glm::vec3(9.0f, 8.6f, 8.0f));       // soft box
  radiance += lamp(direction, {1.0f, 0.45f, 0.25f}, {0.07f, 0.45f}, glm::vec3(5.0f, 6.5f, 9.0f));       // cool strip
  radiance += lamp(direction, {0.5f, 1.0f, 0.55f}, {0.05f, 0.05f}, glm::vec3(180.0f, 160.0f, 130.0f));  // spot
  radiance += lamp(direction, {-0.35f, 0.5f, -1.0f}, {0.38f, 0.09f}, glm::vec3(4.0f, 2.2f, 1.0f));      // warm strip
  for (int i = 0; i < 12; ++i) {                                                                        // row of bulbs
    const float angle = glm::two_pi<float>() * (static_cast<float>(i) + 0.5f) / 12.0f;
    const glm::vec3 towards(std::sin(angle), 0.22f, std::cos(angle));
    radiance += lamp(direction, towards, {0.035f, 0.035f}, i % 2 == 0 ? glm::vec3(28, 18, 9) : glm::vec3(9, 16, 28));
  }
  return radiance;
}

}  // namespace

void writeStudioEnvironment(const std::filesystem::path& file) {
  constexpr int kWidth = 128;
  constexpr int kHeight = 64;
  std::vector<glm::vec3> radiance;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const float longitude = ((static_cast<float>(x) + 0.5f) / kWidth - 0.5f) * glm::two_pi<float>();
      const float polar = (static_cast<float>(y) + 0.5f) / kHeight * glm::pi<float>();
      const float ring = std::sin(polar);
      radiance.push_back(studioRadiance({ring * std::sin(longitude), std::cos(polar), -ring * std::cos(longitude)}));
    }
  }
  writeExr(file, kWidth, kHeight, radiance);
}

Scene makeReflective() {
  Scene scene;
  addTable(scene.glb);
  addObjects(scene.glb);
  Shot shot;
  shot.name = "reflective";
  shot.description = "glossy metal and glazed shapes at 1.0-5 m under a studio environment, focus on the teapot";
  shot.camera = {.position = {0.0f, 0.55f, 1.95f}, .target = {0.0f, 0.20f, 0.0f}, .fovyDeg = 36.0f};
  shot.lens = {.apertureRadius = 0.05, .focusDistance = 1.92};
  shot.background = {0.10, 0.10, 0.12};
  shot.lit = true;
  shot.environment = "studio.exr";
  scene.shots.push_back(shot);
  return scene;
}

}  // namespace scenes
