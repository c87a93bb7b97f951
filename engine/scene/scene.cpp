// Computes bounds and flat normals of a scene, and finds what is wrong with it. No file formats here.
#include "engine/scene/scene.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace lensgraph::engine {
namespace {

bool isFinite(const glm::vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool isFinite(const glm::dmat4& m) {
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) {
      if (!std::isfinite(m[column][row])) return false;
    }
  }
  return true;
}

std::string element(const char* array, size_t index, const char* member = "") {
  return std::string(array) + "[" + std::to_string(index) + "]" + member;
}

using Problems = std::vector<std::string>;

void checkPrimitive(const Scene& scene, size_t index, Problems& problems) {
  const Primitive& primitive = scene.primitives[index];
  const size_t count = primitive.positions.size();
  if (primitive.material >= scene.materials.size()) {
    problems.push_back(element("primitives", index, ".material: index out of range"));
  }
  const auto checkLength = [&](size_t length, const char* member) {
    if (length != 0 && length != count)
      problems.push_back(element("primitives", index, member) + ": length differs from positions");
  };
  checkLength(primitive.normals.size(), ".normals");
  checkLength(primitive.tangents.size(), ".tangents");
  checkLength(primitive.uvs[0].size(), ".uvs[0]");
  checkLength(primitive.uvs[1].size(), ".uvs[1]");
  checkLength(primitive.colors.size(), ".colors");
  if (primitive.indices.size() % 3 != 0) {
    problems.push_back(element("primitives", index, ".indices: count is not a multiple of 3"));
  }
  for (uint32_t i : primitive.indices) {
    if (i >= count) {
      problems.push_back(element("primitives", index, ".indices: index out of range"));
      break;
    }
  }
  for (const glm::vec3& position : primitive.positions) {
    if (!isFinite(position)) {
      problems.push_back(element("primitives", index, ".positions: not finite"));
      break;
    }
  }
}

void checkTextureUse(const Scene& scene, size_t material, const TextureUse& use, const char* member,
                     Problems& problems) {
  if (!use.isUsed()) return;
  if (use.texture >= scene.textures.size()) {
    problems.push_back(element("materials", material, member) + ": texture index out of range");
  }
  if (use.uvSet > 1) problems.push_back(element("materials", material, member) + ": UV set is neither 0 nor 1");
}

}  // namespace

void Bounds::add(const glm::dvec3& point) {
  min = glm::min(min, point);
  max = glm::max(max, point);
}

void Bounds::add(const Bounds& other) {
  min = glm::min(min, other.min);
  max = glm::max(max, other.max);
}

glm::vec2 transformUv(const TextureUse& use, glm::vec2 uv) {
  const float c = std::cos(use.rotation);
  const float s = std::sin(use.rotation);
  const glm::vec2 scaled = use.scale * uv;
  return use.offset + glm::vec2(c * scaled.x + s * scaled.y, -s * scaled.x + c * scaled.y);
}

Bounds worldBounds(const Scene& scene) {
  Bounds bounds;
  for (const Instance& instance : scene.instances) {
    for (const glm::vec3& position : scene.primitives[instance.primitive].positions) {
      bounds.add(glm::dvec3(instance.worldFromObject * glm::dvec4(position, 1.0)));
    }
  }
  return bounds;
}

uint64_t triangleCount(const Scene& scene) {
  uint64_t count = 0;
  for (const Instance& instance : scene.instances) count += scene.primitives[instance.primitive].triangleCount();
  return count;
}

const SceneCamera* findCamera(const Scene& scene, const std::string& name) {
  for (const SceneCamera& camera : scene.cameras) {
    if (camera.name == name) return &camera;
  }
  for (const SceneCamera& camera : scene.cameras) {
    if (camera.nodeName == name) return &camera;
  }
  return nullptr;
}

std::vector<std::string> findProblems(const Scene& scene) {
  Problems problems;
  for (size_t i = 0; i < scene.primitives.size(); ++i) checkPrimitive(scene, i, problems);
  for (size_t i = 0; i < scene.instances.size(); ++i) {
    if (scene.instances[i].primitive >= scene.primitives.size()) {
      problems.push_back(element("instances", i, ".primitive: index out of range"));
    }
    if (!isFinite(scene.instances[i].worldFromObject)) {
      problems.push_back(element("instances", i, ".worldFromObject: not finite"));
    }
  }
  for (size_t i = 0; i < scene.materials.size(); ++i) {
    const Material& material = scene.materials[i];
    checkTextureUse(scene, i, material.baseColorTexture, ".baseColorTexture", problems);
    checkTextureUse(scene, i, material.emissiveTexture, ".emissiveTexture", problems);
    checkTextureUse(scene, i, material.metallicRoughnessTexture, ".metallicRoughnessTexture", problems);
    checkTextureUse(scene, i, material.normalTexture, ".normalTexture", problems);
    checkTextureUse(scene, i, material.occlusionTexture, ".occlusionTexture", problems);
  }
  for (size_t i = 0; i < scene.textures.size(); ++i) {
    if (scene.textures[i].image >= scene.images.size()) {
      problems.push_back(element("textures", i, ".image: index out of range"));
    }
  }
  for (size_t i = 0; i < scene.images.size(); ++i) {
    const SceneImage& image = scene.images[i];
    if (image.width == 0 || image.height == 0) problems.push_back(element("images", i, ": no pixels"));
    if (image.rgba.size() != size_t{image.width} * image.height * 4) {
      problems.push_back(element("images", i, ".rgba: length does not match width and height"));
    }
  }
  return problems;
}

void computeFlatNormals(Primitive& primitive) {
  Primitive flat;
  const size_t count = primitive.indices.size() - primitive.indices.size() % 3;
  const auto pick = [&](const auto& source, auto& target) {
    if (source.empty()) return;
    target.reserve(count);
    for (size_t i = 0; i < count; ++i) target.push_back(source[primitive.indices[i]]);
  };
  pick(primitive.positions, flat.positions);
  pick(primitive.uvs[0], flat.uvs[0]);
  pick(primitive.uvs[1], flat.uvs[1]);
  pick(primitive.colors, flat.colors);
  flat.normals.resize(count);
  flat.indices.resize(count);
  for (size_t i = 0; i < count; i += 3) {
    // Double: the cross product of edges near 1e20 m or 1e-20 m would overflow or vanish in float.
    const glm::dvec3 a(flat.positions[i]), b(flat.positions[i + 1]), c(flat.positions[i + 2]);
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double length = glm::length(normal);
    const glm::vec3 unit = length > 0.0 ? glm::vec3(normal / length) : glm::vec3(0.0f, 0.0f, 1.0f);
    for (size_t k = i; k < i + 3; ++k) {
      flat.normals[k] = unit;
      flat.indices[k] = static_cast<uint32_t>(k);
    }
  }
  primitive.positions = std::move(flat.positions);
  primitive.normals = std::move(flat.normals);
  primitive.tangents.clear();
  primitive.uvs[0] = std::move(flat.uvs[0]);
  primitive.uvs[1] = std::move(flat.uvs[1]);
  primitive.colors = std::move(flat.colors);
  primitive.indices = std::move(flat.indices);
}

}  // namespace lensgraph::engine
