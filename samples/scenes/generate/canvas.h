// Small pictures for textures: painting, noise, lettering, and encoding as PNG and EXR.
//
// A canvas holds display values as a PNG does: sRGB-encoded colour in [0, 1], alpha linear and not multiplied
// in. Top row first.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <string_view>
#include <vector>

namespace scenes {

class Canvas {
 public:
  Canvas(int width, int height, glm::vec4 color = glm::vec4(1.0f));

  int width() const { return width_; }
  int height() const { return height_; }
  glm::vec4& at(int x, int y) { return pixels_[static_cast<size_t>(y * width_ + x)]; }
  const glm::vec4& at(int x, int y) const { return pixels_[static_cast<size_t>(y * width_ + x)]; }

  /// Every pixel from its centre, in [0, 1]² with y down.
  void paint(const std::function<glm::vec4(glm::vec2)>& color);
  /// Opaque rectangle in pixels; what lies outside is cut.
  void fill(glm::ivec2 topLeft, glm::ivec2 size, glm::vec4 color);
  /// Capital letters, digits and .,-!:&' in a 5×7 face drawn with round pen strokes. dot: pixels per dot of
  /// the face; a line of n letters is (6n − 1) dots wide and 7 high.
  void write(std::string_view text, glm::vec2 topLeft, float dot, glm::vec4 color);
  /// The same, centred about x.
  void writeCentered(std::string_view text, glm::vec2 topCenter, float dot, glm::vec4 color);

 private:
  int width_;
  int height_;
  std::vector<glm::vec4> pixels_;
};

/// Smooth noise in [0, 1] that repeats every `period` units in x and y.
float tilingNoise(glm::vec2 point, int period, uint32_t seed);
/// Octaves of it, each twice as fine and half as strong.
float tilingClouds(glm::vec2 point, int period, uint32_t seed, int octaves);

/// PNG file in memory: RGB, or RGBA where alpha is asked for. level: zlib's, 1 (quick) to 9 (small). Throws
/// std::runtime_error.
std::vector<uint8_t> encodePng(const Canvas& canvas, bool alpha, int level = 9);
/// RGB half float EXR of linear radiance, row by row. Throws std::runtime_error.
void writeExr(const std::filesystem::path& file, int width, int height, const std::vector<glm::vec3>& radiance);

}  // namespace scenes
