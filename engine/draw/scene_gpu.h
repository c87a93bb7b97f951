// A scene on the device: vertices, indices, materials, textures, and the list of draws.
#pragma once

#include <glm/mat4x4.hpp>
#include <vector>

#include "engine/scene/scene.h"
#include "engine/vulkan/device.h"
#include "engine/vulkan/memory.h"
#include "engine/vulkan/pipelines.h"

namespace lensgraph::engine {

/// Vertex layout: position, normal, uv 0, uv 1, colour; 56 bytes, interleaved.
struct SceneVertex {
  float position[3], normal[3], uv0[2], uv1[2], color[4];
};

/// What a matrix does to the winding of triangles, which tells their front from their back.
enum class Winding : uint8_t {
  kept,
  turned,  ///< Negative determinant: the matrix mirrors.
  lost,    ///< No determinant: the matrix flattens a dimension, and nothing is in front or behind.
};

/// A matrix whose determinant is 0 within rounding loses the winding.
Winding windingOf(const glm::dmat4& worldFromObject);

struct SceneDrawItem {
  uint32_t firstIndex = 0, indexCount = 0;
  int32_t vertexOffset = 0;
  uint32_t material = 0;
  AlphaMode alphaMode = AlphaMode::opaque;
  bool doubleSided = false;
  glm::dmat4 worldFromObject{1.0};
  Winding winding = Winding::kept;  ///< By worldFromObject.
};

/// Descriptor set 1 of a material: base colour, emissive, metallic-roughness, normal, occlusion.
inline constexpr uint32_t kMaterialTextures = 5;

/// Immutable after construction. The device outlives it.
class SceneGpu {
 public:
  /// Uploads the scene; the Scene is not needed afterwards. Precondition: findProblems(scene) is empty.
  SceneGpu(const Device& device, PipelineStore& pipelines, const Scene& scene);

  VkBuffer vertices() const { return vertices_.buffer.get(); }
  VkBuffer indices() const { return indices_.buffer.get(); }
  VkBuffer materials() const { return materials_.buffer.get(); }
  /// Opaque first, then masked, then blended; within each by material, and then by winding.
  const std::vector<SceneDrawItem>& draws() const { return draws_; }
  VkDescriptorSet materialSet(uint32_t material) const { return materialSets_[material]; }
  VkDescriptorSetLayout materialSetLayout() const { return materialSetLayout_; }
  bool hasTransparency() const { return hasTransparency_; }

 private:
  void uploadGeometry(const Scene& scene);
  void uploadMaterials(const Scene& scene);
  void uploadImages(const Scene& scene);
  void makeMaterialSets(PipelineStore& pipelines, const Scene& scene);
  VkSampler samplerFor(const Texture& texture);

  const Device& device_;
  GpuBuffer vertices_, indices_, materials_;
  std::vector<SceneDrawItem> draws_;
  std::vector<GpuImage> images_;  ///< As in the scene; one white texel at the end.
  std::vector<std::pair<VkSamplerCreateInfo, Unique<VkSampler>>> samplers_;
  Unique<VkDescriptorPool> pool_;
  VkDescriptorSetLayout materialSetLayout_ = VK_NULL_HANDLE;
  std::vector<VkDescriptorSet> materialSets_;
  bool hasTransparency_ = false;
};

}  // namespace lensgraph::engine
