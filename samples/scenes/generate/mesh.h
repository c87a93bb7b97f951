// Triangle meshes as the scenes need them: primitives, placement, and light baked into vertex colours.
//
// Lengths in metres, right-handed, +Y up; counter-clockwise is front; normals of unit length; colours linear.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

namespace scenes {

struct Vertex {
  glm::vec3 position{0.0f};
  glm::vec3 normal{0.0f, 1.0f, 0.0f};
  glm::vec2 uv{0.0f};
  glm::vec4 color{1.0f};
};

struct Mesh {
  std::vector<Vertex> vertices;
  std::vector<uint32_t> indices;  ///< Three per triangle.

  size_t triangleCount() const { return indices.size() / 3; }
};

/// Parallelogram center ± halfU ± halfV whose front is cross(halfU, halfV). UV runs from (0, uvScale.y) at
/// -halfU -halfV to (uvScale.x, 0) at the opposite corner, so that a texture stands upright with halfV up.
Mesh makeRectangle(glm::vec3 center, glm::vec3 halfU, glm::vec3 halfV, glm::vec2 uvScale = glm::vec2(1.0f),
                   glm::ivec2 divisions = glm::ivec2(1));

Mesh makeBox(glm::vec3 center, glm::vec3 halfSize);

/// Unit sphere about the origin, poles on the Y axis. 2 · sectors · (rings − 1) triangles.
Mesh makeSphere(int rings, int sectors);

/// Ring in the XY plane about the origin.
Mesh makeTorus(float majorRadius, float minorRadius, int majorSegments, int minorSegments);

struct TubePoint {
  glm::vec3 position;
  float radius;  ///< m; 0 at an end closes it to a point.
};

/// Round tube along a path of at least two points, ends closed. v of the UV counts metres along the path.
Mesh makeTube(std::span<const TubePoint> path, int sides);

/// Surface of revolution about Y. The profile is (radius, y) from bottom to top, outside to the right.
Mesh makeLathe(std::span<const glm::vec2> profile, int sectors);

void append(Mesh& mesh, const Mesh& addition);
Mesh transformed(Mesh mesh, const glm::mat4& matrix);
Mesh colored(Mesh mesh, glm::vec4 color);

/// One sun and a sky, multiplied into the vertex colours, so that unlit scenes have form.
struct BakedLight {
  glm::vec3 towardsSun{0.4f, 0.8f, 0.45f};
  glm::vec3 sun{0.75f, 0.72f, 0.65f};
  glm::vec3 sky{0.32f, 0.36f, 0.42f};     ///< From above.
  glm::vec3 ground{0.12f, 0.11f, 0.10f};  ///< From below.
  bool twoSided = false;                  ///< The side that faces the sun counts: for leaves.
};
void bakeLight(Mesh& mesh, const BakedLight& light = {});

/// Transform that takes +Y to the direction and the origin to the base.
glm::mat4 standingAlong(glm::vec3 base, glm::vec3 direction, float twist = 0.0f);

}  // namespace scenes
