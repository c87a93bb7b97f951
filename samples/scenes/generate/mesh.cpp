// Primitives with counter-clockwise fronts; see mesh.h.
#include "generate/mesh.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_inverse.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace scenes {
namespace {

/// Two triangles per cell of a (columns + 1) × (rows + 1) grid of vertices; front where rows grow to the left
/// of the direction in which columns grow.
void addGridIndices(Mesh& mesh, uint32_t first, int columns, int rows) {
  const auto stride = static_cast<uint32_t>(columns + 1);
  for (uint32_t row = 0; row < static_cast<uint32_t>(rows); ++row) {
    for (uint32_t column = 0; column < static_cast<uint32_t>(columns); ++column) {
      const uint32_t a = first + row * stride + column;
      mesh.indices.insert(mesh.indices.end(), {a, a + 1, a + stride + 1, a, a + stride + 1, a + stride});
    }
  }
}

/// Drops triangles with two corners at one place: the poles of spheres and the points of tubes.
void dropDegenerate(Mesh& mesh) {
  std::vector<uint32_t> kept;
  kept.reserve(mesh.indices.size());
  for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const glm::vec3 a = mesh.vertices[mesh.indices[i]].position;
    const glm::vec3 b = mesh.vertices[mesh.indices[i + 1]].position;
    const glm::vec3 c = mesh.vertices[mesh.indices[i + 2]].position;
    if (a == b || b == c || c == a) continue;
    kept.insert(kept.end(), mesh.indices.begin() + static_cast<ptrdiff_t>(i),
                mesh.indices.begin() + static_cast<ptrdiff_t>(i) + 3);
  }
  mesh.indices = std::move(kept);
}

glm::vec3 anyPerpendicular(glm::vec3 direction) {
  const glm::vec3 helper = std::abs(direction.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
  return glm::normalize(glm::cross(helper, direction));
}

/// Flat lid on a tube's end, facing outward.
void addLid(Mesh& mesh, const TubePoint& end, glm::vec3 outward, glm::vec3 side, int sides) {
  if (end.radius <= 0.0f) return;
  const glm::vec3 other = glm::cross(outward, side);
  const auto center = static_cast<uint32_t>(mesh.vertices.size());
  mesh.vertices.push_back({end.position, outward, {0.5f, 0.5f}, glm::vec4(1.0f)});
  for (int i = 0; i < sides; ++i) {
    const float angle = glm::two_pi<float>() * static_cast<float>(i) / static_cast<float>(sides);
    const glm::vec3 offset = side * std::cos(angle) + other * std::sin(angle);
    mesh.vertices.push_back({end.position + offset * end.radius, outward, {0.5f, 0.5f}, glm::vec4(1.0f)});
  }
  for (uint32_t i = 0; i < static_cast<uint32_t>(sides); ++i) {
    const uint32_t next = (i + 1) % static_cast<uint32_t>(sides);
    mesh.indices.insert(mesh.indices.end(), {center, center + 1 + i, center + 1 + next});
  }
}

}  // namespace

Mesh makeRectangle(glm::vec3 center, glm::vec3 halfU, glm::vec3 halfV, glm::vec2 uvScale, glm::ivec2 divisions) {
  Mesh mesh;
  const glm::vec3 normal = glm::normalize(glm::cross(halfU, halfV));
  for (int row = 0; row <= divisions.y; ++row) {
    for (int column = 0; column <= divisions.x; ++column) {
      const glm::vec2 t(static_cast<float>(column) / static_cast<float>(divisions.x),
                        static_cast<float>(row) / static_cast<float>(divisions.y));
      const glm::vec3 position = center + halfU * (2.0f * t.x - 1.0f) + halfV * (2.0f * t.y - 1.0f);
      mesh.vertices.push_back({position, normal, {t.x * uvScale.x, (1.0f - t.y) * uvScale.y}, glm::vec4(1.0f)});
    }
  }
  addGridIndices(mesh, 0, divisions.x, divisions.y);
  return mesh;
}

Mesh makeBox(glm::vec3 center, glm::vec3 halfSize) {
  Mesh mesh;
  for (int axis = 0; axis < 3; ++axis) {
    for (const float sign : {-1.0f, 1.0f}) {
      glm::vec3 outward(0.0f);
      glm::vec3 u(0.0f);
      glm::vec3 v(0.0f);
      outward[axis] = sign * halfSize[axis];
      u[(axis + 1) % 3] = sign * halfSize[(axis + 1) % 3];
      v[(axis + 2) % 3] = halfSize[(axis + 2) % 3];
      append(mesh, makeRectangle(center + outward, u, v));
    }
  }
  return mesh;
}

Mesh makeSphere(int rings, int sectors) {
  std::vector<glm::vec2> profile;
  for (int ring = 0; ring <= rings; ++ring) {
    const float angle = glm::pi<float>() * (static_cast<float>(ring) / static_cast<float>(rings) - 0.5f);
    const bool pole = ring == 0 || ring == rings;
    profile.emplace_back(pole ? 0.0f : std::cos(angle), std::sin(angle));
  }
  Mesh mesh = makeLathe(profile, sectors);
  for (Vertex& vertex : mesh.vertices) vertex.normal = glm::normalize(vertex.position);
  return mesh;
}

Mesh makeTorus(float majorRadius, float minorRadius, int majorSegments, int minorSegments) {
  Mesh mesh;
  for (int major = 0; major <= majorSegments; ++major) {
    const float u = static_cast<float>(major % majorSegments) / static_cast<float>(majorSegments);
    const glm::vec3 outward(std::cos(u * glm::two_pi<float>()), std::sin(u * glm::two_pi<float>()), 0.0f);
    for (int minor = 0; minor <= minorSegments; ++minor) {
      const float v = static_cast<float>(minor % minorSegments) / static_cast<float>(minorSegments);
      const float angle = v * glm::two_pi<float>();
      const glm::vec3 normal = outward * std::cos(angle) - glm::vec3(0, 0, 1) * std::sin(angle);
      mesh.vertices.push_back({outward * majorRadius + normal * minorRadius, normal, {u, v}, glm::vec4(1.0f)});
    }
  }
  addGridIndices(mesh, 0, minorSegments, majorSegments);
  return mesh;
}

Mesh makeTube(std::span<const TubePoint> path, int sides) {
  Mesh mesh;
  const size_t count = path.size();
  glm::vec3 side(0.0f);
  float distance = 0.0f;
  for (size_t i = 0; i < count; ++i) {
    const glm::vec3 before = path[i == 0 ? 0 : i - 1].position;
    const glm::vec3 after = path[i + 1 == count ? i : i + 1].position;
    const glm::vec3 along = glm::normalize(after - before);
    side = i == 0 ? anyPerpendicular(along) : glm::normalize(side - along * glm::dot(side, along));
    const glm::vec3 other = glm::cross(along, side);
    if (i == 0) addLid(mesh, path[0], -along, side, sides);
    if (i > 0) distance += glm::length(path[i].position - before);
    for (int j = 0; j <= sides; ++j) {
      const float u = static_cast<float>(j % sides) / static_cast<float>(sides);
      const float angle = u * glm::two_pi<float>();
      const glm::vec3 normal = side * std::cos(angle) + other * std::sin(angle);
      const float shownU = static_cast<float>(j) / static_cast<float>(sides);
      mesh.vertices.push_back(
          {path[i].position + normal * path[i].radius, normal, {shownU, distance}, glm::vec4(1.0f)});
    }
    if (i > 0) {
      const auto stride = static_cast<uint32_t>(sides + 1);
      addGridIndices(mesh, static_cast<uint32_t>(mesh.vertices.size()) - 2 * stride, sides, 1);
    }
    if (i + 1 == count) addLid(mesh, path[i], along, side, sides);
  }
  dropDegenerate(mesh);
  return mesh;
}

Mesh makeLathe(std::span<const glm::vec2> profile, int sectors) {
  Mesh mesh;
  const auto last = profile.size() - 1;
  for (size_t i = 0; i < profile.size(); ++i) {
    const glm::vec2 along = profile[i == last ? i : i + 1] - profile[i == 0 ? 0 : i - 1];
    const glm::vec2 outward = glm::normalize(glm::vec2(along.y, -along.x));
    for (int j = 0; j <= sectors; ++j) {
      const float angle = glm::two_pi<float>() * static_cast<float>(j % sectors) / static_cast<float>(sectors);
      const glm::vec3 radial(std::sin(angle), 0.0f, std::cos(angle));
      const glm::vec2 uv(static_cast<float>(j) / static_cast<float>(sectors),
                         1.0f - static_cast<float>(i) / static_cast<float>(last));
      mesh.vertices.push_back({radial * profile[i].x + glm::vec3(0, profile[i].y, 0),
                               glm::normalize(radial * outward.x + glm::vec3(0, outward.y, 0)), uv, glm::vec4(1.0f)});
    }
  }
  addGridIndices(mesh, 0, sectors, static_cast<int>(last));
  dropDegenerate(mesh);
  return mesh;
}

void append(Mesh& mesh, const Mesh& addition) {
  const auto first = static_cast<uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), addition.vertices.begin(), addition.vertices.end());
  for (const uint32_t index : addition.indices) mesh.indices.push_back(first + index);
}

Mesh transformed(Mesh mesh, const glm::mat4& matrix) {
  const glm::mat3 normalMatrix = glm::inverseTranspose(glm::mat3(matrix));
  for (Vertex& vertex : mesh.vertices) {
    vertex.position = glm::vec3(matrix * glm::vec4(vertex.position, 1.0f));
    vertex.normal = glm::normalize(normalMatrix * vertex.normal);
  }
  return mesh;
}

Mesh colored(Mesh mesh, glm::vec4 color) {
  for (Vertex& vertex : mesh.vertices) vertex.color = color;
  return mesh;
}

void bakeLight(Mesh& mesh, const BakedLight& light) {
  const glm::vec3 towardsSun = glm::normalize(light.towardsSun);
  for (Vertex& vertex : mesh.vertices) {
    const float facing = glm::dot(vertex.normal, towardsSun);
    const float lit = light.twoSided ? 0.35f + 0.65f * std::abs(facing) : std::max(0.0f, facing);
    const float upward = light.twoSided ? 0.7f : 0.5f + 0.5f * vertex.normal.y;
    const glm::vec3 received = light.sun * lit + glm::mix(light.ground, light.sky, upward);
    vertex.color = glm::vec4(glm::vec3(vertex.color) * received, vertex.color.a);
  }
}

glm::mat4 standingAlong(glm::vec3 base, glm::vec3 direction, float twist) {
  const glm::vec3 y = glm::normalize(direction);
  const glm::vec3 x = anyPerpendicular(y);
  const glm::vec3 z = glm::cross(x, y);
  const glm::mat4 frame(glm::vec4(x, 0.0f), glm::vec4(y, 0.0f), glm::vec4(z, 0.0f), glm::vec4(base, 1.0f));
  return glm::rotate(frame, twist, glm::vec3(0, 1, 0));
}

}  // namespace scenes
