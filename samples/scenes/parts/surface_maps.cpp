// Normals are central differences of the heights, which wrap round the tile; see surface_maps.h.
#include "parts/surface_maps.h"

#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <vector>

namespace scenes {

SurfaceMaps mapsOf(const Relief& relief) {
  const int size = relief.size;
  SurfaceMaps maps{Canvas(size, size), Canvas(size, size), Canvas(size, size)};
  std::vector<float> heights;
  heights.reserve(static_cast<size_t>(size) * static_cast<size_t>(size));
  const auto pointAt = [size](int x, int y) { return (glm::vec2(x, y) + 0.5f) / static_cast<float>(size); };
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) heights.push_back(relief.height(pointAt(x, y)));
  }
  const auto heightAt = [&](int x, int y) {
    return heights[static_cast<size_t>((y + size) % size * size + (x + size) % size)];
  };
  const float slope = relief.depth * static_cast<float>(size) * 0.5f;  // Of a difference across two texels.
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const glm::vec3 normal = glm::normalize(glm::vec3((heightAt(x - 1, y) - heightAt(x + 1, y)) * slope,
                                                        (heightAt(x, y + 1) - heightAt(x, y - 1)) * slope, 1.0f));
      const glm::vec2 point = pointAt(x, y);
      const float height = heightAt(x, y);
      maps.color.at(x, y) = glm::vec4(relief.color(point, height), 1.0f);
      maps.normal.at(x, y) = glm::vec4(normal * 0.5f + 0.5f, 1.0f);
      maps.metallicRoughness.at(x, y) = glm::vec4(1.0f, relief.roughness(point, height), relief.metallic, 1.0f);
    }
  }
  return maps;
}

int addSurface(Glb& glb, const std::string& name, const Relief& relief, bool doubleSided) {
  const SurfaceMaps maps = mapsOf(relief);
  return glb.addMaterial(
      {.name = name,
       .texture = glb.addTexture(name, maps.color, Wrap::repeat),
       .doubleSided = doubleSided,
       .unlit = false,
       .metallic = 1.0f,
       .normalTexture = glb.addTexture(name + " normals", maps.normal, Wrap::repeat),
       .metallicRoughnessTexture = glb.addTexture(name + " roughness", maps.metallicRoughness, Wrap::repeat)});
}

}  // namespace scenes
