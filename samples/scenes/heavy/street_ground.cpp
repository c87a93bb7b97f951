// Cobbles as geometry where one sees them singly, as a texture beyond; curbs and slabs; see street.h.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "generate/random.h"
#include "heavy/street.h"
#include "parts/furniture.h"
#include "parts/shapes.h"
#include "parts/surfaces.h"

namespace scenes {
namespace {

constexpr int kCobbledLength = 14;  // m of real stones; beyond them a texture.

/// Something that keeps the sun from the ground: a foot, and a shadow that runs from it as wide as it is.
struct Blocker {
  glm::vec2 at;
  float radius;  ///< m
  float height;  ///< m
};

/// Share of the light that reaches the ground. Nothing else casts shadows, so those that matter are in vertex colors.
float lightOnGround(glm::vec2 point) {
  static constexpr std::array<Blocker, 8> kBlockers = {
      Blocker{{0.28f, -3.45f}, 0.24f, 0.42f}, {{-0.42f, -3.60f}, 0.26f, 1.1f}, {{-0.22f, -3.64f}, 0.22f, 1.1f},
      {{-0.60f, -3.56f}, 0.22f, 1.1f},        {{0.72f, -3.75f}, 0.2f, 0.8f},   {{3.45f, -6.5f}, 0.07f, 3.4f},
      {{3.45f, -15.5f}, 0.07f, 3.4f},         {{3.6f, -13.0f}, 0.55f, 4.5f}};
  const glm::vec3 towardsSun = glm::normalize(kTowardsSun);
  const glm::vec2 across(towardsSun.x, towardsSun.z);
  float light = 1.0f;
  for (const Blocker& blocker : kBlockers) {
    const glm::vec2 shadow = -across * (blocker.height / towardsSun.y);
    const float t = glm::clamp(glm::dot(point - blocker.at, shadow) / glm::dot(shadow, shadow), 0.0f, 1.0f);
    const float distance = glm::length(point - blocker.at - shadow * t);
    const float blur = 0.04f + 0.12f * t;
    light =
        std::min(light, glm::mix(0.42f, 1.0f, glm::smoothstep(blocker.radius - blur, blocker.radius + blur, distance)));
    light *= glm::mix(0.6f, 1.0f,
                      glm::smoothstep(0.8f * blocker.radius, 1.5f * blocker.radius, glm::length(point - blocker.at)));
  }
  return light * glm::mix(0.55f, 1.0f, glm::smoothstep(0.0f, 0.35f, kRoadHalfWidth - std::abs(point.x)));
}

}  // namespace

void addStreetGround(Glb& glb, const StreetMaterials& materials) {
  Random random(99);
  const int stone = addSurface(glb, "cobbles", graniteRelief(12));
  const int across = static_cast<int>(2.0f * kRoadHalfWidth);
  for (int row = 0; row < kCobbledLength; ++row) {
    Mesh cobbles;
    for (int column = 0; column < across; ++column) {
      const glm::vec2 corner(static_cast<float>(column) - kRoadHalfWidth, 1.0f - static_cast<float>(row));
      append(cobbles, makeCobblePatch(corner, lightOnGround, random));
    }
    glb.add("cobbles", cobbles, stone, kTinted);
  }
  const float end = 1.0f - static_cast<float>(kCobbledLength);
  const float farHalf = (end + kStreetLength) * 0.5f;
  const int farCobbles = addSurface(glb, "far cobbles", cobbleRelief(13));
  glb.add("far cobbles",
          makeRectangle({0, 0, end - farHalf}, {kRoadHalfWidth, 0, 0}, {0, 0, -farHalf},
                        {2.0f * kRoadHalfWidth, 2.0f * farHalf}),
          farCobbles, kTextured);
  const int soil = glb.addMaterial({.name = "joints", .baseColor = {0.05f, 0.045f, 0.04f, 1}, .unlit = false});
  glb.add("joints", makeRectangle({0, -0.008f, -6.0f}, {kRoadHalfWidth, 0, 0}, {0, 0, -7.1f}), soil, {.normals = true});
  Mesh pavement;
  for (const float side : {-1.0f, 1.0f}) {
    for (int i = 0; i < 50; ++i) {
      const float z = 3.0f - static_cast<float>(i);
      const float inner = side * (kRoadHalfWidth + 0.16f), outer = side * (kHalfWidth + 0.3f);
      append(pavement, boxBetween({std::min(side * kRoadHalfWidth, inner), -0.1f, z - 0.99f},
                                  {std::max(side * kRoadHalfWidth, inner), 0.13f, z}));
      append(pavement, boxBetween({std::min(inner, outer), -0.1f, z - 0.985f}, {std::max(inner, outer), 0.12f, z}));
    }
  }
  mapPlanar(pavement, 0.5f);
  glb.add("pavement", pavement, materials.granite, kTextured);
}

}  // namespace scenes
