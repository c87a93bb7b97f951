// See shapes.h. Fronts are counter-clockwise, as in generate/mesh.cpp.
#include "parts/shapes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace scenes {

Mesh boxBetween(glm::vec3 low, glm::vec3 high) {
  return makeBox((low + high) * 0.5f, (high - low) * 0.5f);
}

Mesh extruded(std::span<const glm::vec2> profile, float halfLength) {
  Mesh mesh;
  for (size_t i = 0; i + 1 < profile.size(); ++i) {
    const glm::vec3 top(0.0f, profile[i].y, profile[i].x);
    const glm::vec3 bottom(0.0f, profile[i + 1].y, profile[i + 1].x);
    append(mesh, makeRectangle((top + bottom) * 0.5f, {halfLength, 0, 0}, (top - bottom) * 0.5f));
  }
  return mesh;
}

glm::quat turned(float yaw) {
  return glm::angleAxis(yaw, glm::vec3(0, 1, 0));
}

void mapPlanar(Mesh& mesh, float metersPerTile) {
  for (Vertex& vertex : mesh.vertices) {
    const glm::vec3 facing = glm::abs(vertex.normal);
    const glm::vec3 p = vertex.position / metersPerTile;
    if (facing.y >= facing.x && facing.y >= facing.z) {
      vertex.uv = {p.x, p.z};
    } else if (facing.x >= facing.z) {
      vertex.uv = {p.z, -p.y};
    } else {
      vertex.uv = {p.x, -p.y};
    }
  }
}

void scaleUv(Mesh& mesh, glm::vec2 factor) {
  for (Vertex& vertex : mesh.vertices) vertex.uv *= factor;
}

void smoothNormals(Mesh& mesh) {
  std::vector<glm::vec3> sums(mesh.vertices.size(), glm::vec3(0.0f));
  for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const uint32_t* corner = &mesh.indices[i];
    const glm::vec3 a = mesh.vertices[corner[0]].position;
    const glm::vec3 area = glm::cross(mesh.vertices[corner[1]].position - a, mesh.vertices[corner[2]].position - a);
    for (int k = 0; k < 3; ++k) sums[corner[k]] += area;
  }
  for (size_t i = 0; i < sums.size(); ++i) {
    if (glm::dot(sums[i], sums[i]) > 0.0f) mesh.vertices[i].normal = glm::normalize(sums[i]);
  }
}

Mesh makeStone(Random& random, glm::vec3 halfSize, float sunk, int divisions) {
  Mesh mesh = makeRectangle(glm::vec3(0.0f), {1, 0, 0}, {0, 0, -1}, glm::vec2(1.0f), glm::ivec2(divisions));
  const float skew = random.between(-0.12f, 0.12f);
  const float tilt = random.between(-0.1f, 0.1f);
  for (Vertex& vertex : mesh.vertices) {
    const glm::vec2 flat(vertex.position.x, vertex.position.z);
    const float rim = std::max(std::abs(flat.x), std::abs(flat.y));
    // Corners are rounded: the square is drawn part of the way towards a disc.
    const float roundness = glm::mix(1.0f, rim / std::max(glm::length(flat), 1e-4f), 0.35f);
    const float rise = 1.0f - rim * rim * rim * rim;
    const float bump = rim < 0.99f ? random.between(-0.06f, 0.06f) : 0.0f;
    vertex.position = {(flat.x * roundness + skew * flat.y) * halfSize.x,
                       halfSize.y * (rise + bump + tilt * flat.x) - sunk * (rim > 0.99f ? 1.0f : 0.0f),
                       flat.y * roundness * halfSize.z};
  }
  smoothNormals(mesh);
  return mesh;
}

Mesh makeFoldedLeaf(float length, float width, float fold, float droop) {
  Mesh mesh;
  for (int row = 0; row < 2; ++row) {
    const float t = static_cast<float>(row);
    for (int column = 0; column < 3; ++column) {
      const float side = static_cast<float>(column - 1);
      const glm::vec3 position(side * width * 0.5f, t * length, length * (fold * std::abs(side) - droop * t));
      mesh.vertices.push_back({position, {0, 0, 1}, {0.5f + 0.5f * side, 1.0f - t}, glm::vec4(1.0f)});
    }
  }
  for (const uint32_t a : {0u, 1u}) {
    mesh.indices.insert(mesh.indices.end(), {a, a + 1, a + 4, a, a + 4, a + 3});
  }
  smoothNormals(mesh);
  return mesh;
}

void shade(Mesh& mesh, float factor) {
  for (Vertex& vertex : mesh.vertices) vertex.color = glm::vec4(glm::vec3(vertex.color) * factor, vertex.color.a);
}

}  // namespace scenes
