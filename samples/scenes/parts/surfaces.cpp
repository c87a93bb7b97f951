// Heights are made of waves, cells and tiling noise; colors and roughness follow the heights. See surfaces.h.
#include "parts/surfaces.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace scenes {
namespace {

float clouds(glm::vec2 point, int period, uint32_t seed, int octaves) {
  return tilingClouds(point * static_cast<float>(period), period, seed, octaves);
}

/// A cell of rows that are each shifted by half a cell: where the point is in it, and which it is.
struct Cell {
  glm::vec2 inside;  ///< In [0, 1]².
  glm::ivec2 index;
};

Cell cellOf(glm::vec2 point, glm::ivec2 count) {
  const float row = std::floor(point.y * static_cast<float>(count.y));
  const float x = point.x * static_cast<float>(count.x) + (std::fmod(row, 2.0f) > 0.5f ? 0.5f : 0.0f);
  const int column = static_cast<int>(std::floor(x)) % count.x;
  return {{x - std::floor(x), point.y * static_cast<float>(count.y) - row}, {column, static_cast<int>(row)}};
}

/// 1 on the cell's body, 0 in its joints. margins: joint and edge widths as shares of the cell.
float bodyOf(glm::vec2 inside, glm::vec2 joint, glm::vec2 edge) {
  const glm::vec2 margin = 0.5f - glm::abs(inside - 0.5f);
  return std::min(glm::smoothstep(joint.x, joint.x + edge.x, margin.x),
                  glm::smoothstep(joint.y, joint.y + edge.y, margin.y));
}

/// The same for every point of a cell.
float toneOf(glm::ivec2 index, uint32_t seed) {
  return tilingNoise(glm::vec2(index) * 1.0f, 64, seed);
}

float rough(float base, float variation, float share) {
  return glm::clamp(base + variation * (share - 0.5f), 0.05f, 1.0f);
}

}  // namespace

Relief brickRelief(glm::vec3 brick, uint32_t seed) {
  Relief relief;
  relief.depth = 0.012f;
  const glm::ivec2 count(4, 12);
  relief.height = [=](glm::vec2 p) {
    const Cell cell = cellOf(p, count);
    return 0.85f * bodyOf(cell.inside, {0.02f, 0.06f}, {0.02f, 0.08f}) + 0.15f * clouds(p, 32, seed, 3);
  };
  relief.color = [=](glm::vec2 p, float height) {
    const float tone =
        0.8f + 0.35f * toneOf(cellOf(p, count).index, seed + 9) + 0.2f * (clouds(p, 8, seed + 3, 4) - 0.5f);
    return glm::mix(glm::vec3(0.62f, 0.58f, 0.53f), brick * tone, glm::smoothstep(0.3f, 0.6f, height));
  };
  relief.roughness = [=](glm::vec2 p, float) { return rough(0.85f, 0.2f, clouds(p, 16, seed + 5, 2)); };
  return relief;
}

Relief plasterRelief(glm::vec3 paint, uint32_t seed) {
  Relief relief;
  relief.depth = 0.004f;
  relief.height = [=](glm::vec2 p) { return clouds(p, 16, seed, 5); };
  relief.color = [=](glm::vec2 p, float height) {
    const float stain = glm::smoothstep(0.5f, 0.8f, clouds(p * glm::vec2(1.0f, 0.5f), 4, seed + 7, 4));
    return paint * (0.92f + 0.16f * (height - 0.5f)) * glm::mix(glm::vec3(1.0f), glm::vec3(0.78f, 0.76f, 0.70f), stain);
  };
  relief.roughness = [=](glm::vec2, float height) { return rough(0.88f, 0.2f, height); };
  return relief;
}

Relief graniteRelief(uint32_t seed) {
  Relief relief;
  relief.depth = 0.012f;
  relief.height = [=](glm::vec2 p) { return clouds(p, 16, seed, 4); };
  relief.color = [=](glm::vec2 p, float height) {
    const float fleck = glm::smoothstep(0.55f, 0.7f, tilingNoise(p * 64.0f, 64, seed + 2));
    return glm::vec3(0.58f, 0.56f, 0.54f) * (0.75f + 0.4f * height) + fleck * 0.08f;
  };
  relief.roughness = [=](glm::vec2 p, float) { return rough(0.55f, 0.35f, clouds(p, 8, seed + 4, 3)); };
  return relief;
}

Relief cobbleRelief(uint32_t seed) {
  Relief relief;
  relief.depth = 0.02f;
  const glm::ivec2 count(8, 8);
  relief.height = [=](glm::vec2 p) {
    const Cell cell = cellOf(p, count);
    return 0.9f * bodyOf(cell.inside, glm::vec2(0.03f), glm::vec2(0.25f)) + 0.1f * clouds(p, 32, seed, 2);
  };
  relief.color = [=](glm::vec2 p, float height) {
    const float tone = 0.92f + 0.16f * toneOf(cellOf(p, count).index, seed + 9);
    return glm::mix(glm::vec3(0.34f, 0.32f, 0.30f), glm::vec3(0.50f, 0.48f, 0.46f) * tone,
                    glm::smoothstep(0.1f, 0.5f, height));
  };
  relief.roughness = [=](glm::vec2, float height) { return rough(0.6f, 0.4f, 1.0f - height); };
  return relief;
}

Relief boardRelief(glm::vec3 wood, uint32_t seed) {
  Relief relief;
  relief.depth = 0.008f;
  constexpr float kBoards = 5.0f;
  const auto grain = [seed](glm::vec2 p) { return tilingClouds(p * glm::vec2(64.0f, 4.0f), 64, seed, 3); };
  relief.height = [=](glm::vec2 p) {
    const float across = p.x * kBoards - std::floor(p.x * kBoards);
    return 0.8f * glm::smoothstep(0.01f, 0.05f, 0.5f - std::abs(across - 0.5f)) + 0.2f * grain(p);
  };
  relief.color = [=](glm::vec2 p, float height) {
    const float tone = 0.85f + 0.3f * toneOf({static_cast<int>(p.x * kBoards), 3}, seed + 1);
    return wood * tone * (0.7f + 0.6f * grain(p)) * glm::smoothstep(0.0f, 0.5f, height);
  };
  relief.roughness = [=](glm::vec2 p, float) { return rough(0.65f, 0.3f, grain(p)); };
  return relief;
}

Relief barkRelief(uint32_t seed) {
  Relief relief;
  relief.depth = 0.05f;
  relief.height = [=](glm::vec2 p) {
    const float bend = 0.12f * (clouds(p, 4, seed + 1, 3) - 0.5f);
    const float furrow = std::abs(tilingNoise({(p.x + bend) * 12.0f, p.y * 3.0f}, 12, seed) * 2.0f - 1.0f);
    return glm::clamp(0.75f * std::sqrt(furrow) + 0.25f * clouds(p, 16, seed + 2, 3), 0.0f, 1.0f);
  };
  relief.color = [=](glm::vec2 p, float height) {
    const float moss = glm::smoothstep(0.55f, 0.75f, clouds(p, 4, seed + 5, 4));
    const glm::vec3 bark = glm::mix(glm::vec3(0.17f, 0.13f, 0.10f), glm::vec3(0.50f, 0.42f, 0.34f), height);
    return glm::mix(bark, glm::vec3(0.30f, 0.36f, 0.14f) * (0.6f + 0.6f * height), moss * 0.7f);
  };
  relief.roughness = [=](glm::vec2, float height) { return rough(0.9f, 0.1f, height); };
  return relief;
}

Relief ironRelief(glm::vec3 paint, uint32_t seed) {
  Relief relief;
  relief.size = 128;
  relief.depth = 0.006f;
  relief.height = [=](glm::vec2 p) { return clouds(p, 16, seed, 3); };
  relief.color = [=](glm::vec2 p, float height) {
    const float rust = glm::smoothstep(0.62f, 0.74f, clouds(p, 6, seed + 3, 4));
    return glm::mix(paint * (0.85f + 0.3f * height), glm::vec3(0.38f, 0.22f, 0.13f), rust * 0.8f);
  };
  relief.roughness = [=](glm::vec2 p, float) { return rough(0.42f, 0.4f, clouds(p, 6, seed + 3, 4)); };
  return relief;
}

Relief brassRelief(uint32_t seed) {
  Relief relief;
  relief.size = 64;
  relief.depth = 0.003f;
  relief.metallic = 1.0f;
  relief.height = [=](glm::vec2 p) { return clouds(p, 8, seed, 3); };
  relief.color = [=](glm::vec2, float height) { return glm::vec3(0.94f, 0.78f, 0.48f) * (0.75f + 0.3f * height); };
  relief.roughness = [=](glm::vec2, float height) { return rough(0.42f, 0.24f, 1.0f - height); };
  return relief;
}

Relief forestFloorRelief(uint32_t seed) {
  Relief relief;
  relief.size = 512;
  relief.depth = 0.02f;
  relief.height = [=](glm::vec2 p) { return clouds(p, 24, seed, 5); };
  relief.color = [=](glm::vec2 p, float height) {
    const glm::vec3 soil = glm::mix(glm::vec3(0.18f, 0.13f, 0.09f), glm::vec3(0.42f, 0.31f, 0.20f), height);
    const float needle = glm::smoothstep(0.62f, 0.7f, tilingNoise(p * glm::vec2(96.0f, 32.0f), 96, seed + 4));
    const float moss = glm::smoothstep(0.42f, 0.62f, clouds(p, 5, seed + 8, 4));
    const glm::vec3 litter = glm::mix(soil, glm::vec3(0.52f, 0.38f, 0.22f), needle * 0.7f);
    return glm::mix(litter, glm::vec3(0.30f, 0.40f, 0.12f) * (0.5f + 0.8f * height), moss * 0.85f);
  };
  relief.roughness = [=](glm::vec2, float height) { return rough(0.92f, 0.1f, height); };
  return relief;
}

Relief clothRelief(glm::vec3 dye, uint32_t seed) {
  Relief relief;
  relief.size = 64;
  relief.depth = 0.01f;
  relief.height = [](glm::vec2 p) {
    const glm::vec2 thread = glm::abs(glm::sin(p * glm::pi<float>() * 8.0f));
    return 0.5f * (thread.x + thread.y);
  };
  relief.color = [=](glm::vec2 p, float height) {
    return dye * (0.75f + 0.25f * height + 0.15f * (clouds(p, 4, seed, 3) - 0.5f));
  };
  relief.roughness = [](glm::vec2, float height) { return rough(0.9f, 0.1f, height); };
  return relief;
}

}  // namespace scenes
