// Painting, lettering and noise; see canvas.h.
#include "generate/canvas.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "generate/font.h"

namespace scenes {
namespace {

constexpr float kPenRadius = 0.46f;  // dots: strokes touch their neighbours without filling small counters.

float distanceToSegment(glm::vec2 point, glm::vec2 a, glm::vec2 b) {
  const glm::vec2 along = b - a;
  const float lengthSquared = glm::dot(along, along);
  const float t = lengthSquared > 0.0f ? glm::clamp(glm::dot(point - a, along) / lengthSquared, 0.0f, 1.0f) : 0.0f;
  return glm::length(point - a - along * t);
}

/// Distance in dots from a point to the strokes of a letter: neighbouring dots are joined; diagonal ones only
/// where no straight way round exists, so that corners stay square and slopes become smooth.
float distanceToLetter(const Glyph& glyph, glm::vec2 point) {
  float nearest = 1e9f;
  for (int y = 0; y < kGlyphHeight; ++y) {
    for (int x = 0; x < kGlyphWidth; ++x) {
      if (!glyph.has(x, y)) continue;
      const glm::vec2 center(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
      nearest = std::min(nearest, glm::length(point - center));
      for (const glm::ivec2 step : {glm::ivec2(1, 0), glm::ivec2(0, 1), glm::ivec2(1, 1), glm::ivec2(-1, 1)}) {
        if (!glyph.has(x + step.x, y + step.y)) continue;
        const bool diagonal = step.x != 0 && step.y != 0;
        if (diagonal && (glyph.has(x + step.x, y) || glyph.has(x, y + step.y))) continue;
        nearest = std::min(nearest, distanceToSegment(point, center, center + glm::vec2(step)));
      }
    }
  }
  return nearest;
}

float hashToUnit(uint32_t x, uint32_t y, uint32_t seed) {
  uint32_t h = x * 0x9E3779B1u ^ y * 0x85EBCA77u ^ seed * 0xC2B2AE3Du;
  h = (h ^ (h >> 15u)) * 0x2C1B3C6Du;
  h = (h ^ (h >> 12u)) * 0x297A2D39u;
  h ^= h >> 15u;
  return static_cast<float>(h >> 8u) * 0x1p-24f;
}

}  // namespace

Canvas::Canvas(int width, int height, glm::vec4 color)
    : width_(width), height_(height), pixels_(static_cast<size_t>(width * height), color) {}

void Canvas::paint(const std::function<glm::vec4(glm::vec2)>& color) {
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x) {
      at(x, y) = color({(static_cast<float>(x) + 0.5f) / static_cast<float>(width_),
                        (static_cast<float>(y) + 0.5f) / static_cast<float>(height_)});
    }
  }
}

void Canvas::fill(glm::ivec2 topLeft, glm::ivec2 size, glm::vec4 color) {
  const glm::ivec2 from = glm::max(topLeft, glm::ivec2(0));
  const glm::ivec2 to = glm::min(topLeft + size, glm::ivec2(width_, height_));
  for (int y = from.y; y < to.y; ++y) {
    for (int x = from.x; x < to.x; ++x) at(x, y) = color;
  }
}

void Canvas::write(std::string_view text, glm::vec2 topLeft, float dot, glm::vec4 color) {
  for (size_t i = 0; i < text.size(); ++i) {
    const Glyph& glyph = glyphOf(text[i]);
    const glm::vec2 origin = topLeft + glm::vec2(static_cast<float>(i * (kGlyphWidth + 1)) * dot, 0.0f);
    const glm::ivec2 from = glm::max(glm::ivec2(glm::floor(origin)), glm::ivec2(0));
    const glm::vec2 size(static_cast<float>(kGlyphWidth) * dot, static_cast<float>(kGlyphHeight) * dot);
    const glm::ivec2 to = glm::min(glm::ivec2(glm::ceil(origin + size)), glm::ivec2(width_, height_));
    for (int y = from.y; y < to.y; ++y) {
      for (int x = from.x; x < to.x; ++x) {
        const glm::vec2 point = (glm::vec2(x, y) + 0.5f - origin) / dot;
        const float inside = (kPenRadius - distanceToLetter(glyph, point)) * dot + 0.5f;
        at(x, y) = glm::mix(at(x, y), color, glm::clamp(inside, 0.0f, 1.0f));
      }
    }
  }
}

void Canvas::writeCentered(std::string_view text, glm::vec2 topCenter, float dot, glm::vec4 color) {
  const float width = (static_cast<float>(text.size() * (kGlyphWidth + 1)) - 1.0f) * dot;
  write(text, topCenter - glm::vec2(width * 0.5f, 0.0f), dot, color);
}

float tilingNoise(glm::vec2 point, int period, uint32_t seed) {
  const glm::vec2 cell = glm::floor(point);
  glm::vec2 t = point - cell;
  t = t * t * (3.0f - 2.0f * t);
  const auto wrapped = [period](float value, int step) {
    return static_cast<uint32_t>(((static_cast<int>(value) + step) % period + period) % period);
  };
  const uint32_t x0 = wrapped(cell.x, 0);
  const uint32_t x1 = wrapped(cell.x, 1);
  const uint32_t y0 = wrapped(cell.y, 0);
  const uint32_t y1 = wrapped(cell.y, 1);
  return glm::mix(glm::mix(hashToUnit(x0, y0, seed), hashToUnit(x1, y0, seed), t.x),
                  glm::mix(hashToUnit(x0, y1, seed), hashToUnit(x1, y1, seed), t.x), t.y);
}

float tilingClouds(glm::vec2 point, int period, uint32_t seed, int octaves) {
  float sum = 0.0f;
  float weight = 0.0f;
  float strength = 1.0f;
  for (int i = 0; i < octaves; ++i, strength *= 0.5f) {
    sum += strength * tilingNoise(point, period, seed + static_cast<uint32_t>(i));
    weight += strength;
    point *= 2.0f;
    period *= 2;
  }
  return sum / weight;
}

}  // namespace scenes
