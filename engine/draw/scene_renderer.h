// Draws a scene in every way that techniques ask for (shaders/shared/emit.h), from any point of the lens.
#pragma once

#include <array>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "engine/draw/environment.h"
#include "engine/draw/scene_gpu.h"
#include "engine/graph/graph_backend.h"
#include "engine/scene/scene.h"
#include "engine/scene/viewpoint.h"
#include "engine/vulkan/memory.h"
#include "shaders/shared/emit.h"
#include "shaders/shared/scene.h"
#include "shaders/shared/view.h"

namespace lensgraph::engine {

struct SceneDrawRequest {
  shared::SceneEmit emit = shared::SceneEmit::opaqueRadiance;
  shared::ViewConstants view{};
  VkExtent2D extent = {0, 0};              ///< px
  std::span<const VkFormat> colorFormats;  ///< Of the rendering that is going on.
  VkFormat depthFormat = VK_FORMAT_UNDEFINED;
  VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
  std::span<const rendergraph::ResolvedBinding> emitBindings;  ///< Descriptor set 2.
};

/// The backend outlives it. Not thread-safe, except that draw() may be called from several recordings at once.
class SceneRenderer {
 public:
  /// Uploads the scene (not needed afterwards). `environment` lights it when shading is lit.
  SceneRenderer(GraphBackend& backend, const Scene& scene, const std::optional<Environment>& environment);
  ~SceneRenderer();
  SceneRenderer(const SceneRenderer&) = delete;
  SceneRenderer& operator=(const SceneRenderer&) = delete;

  /// Precondition: no submission that draws the scene is under way.
  void setViewpoint(const SceneViewpoint& viewpoint);
  bool hasTransparency() const { return gpu_.hasTransparency(); }
  /// What lights the scene, to be bound by others; at rest in SHADER_READ_ONLY_OPTIMAL. Live as long as this object.
  const GpuImage& environment() const { return environmentImage_; }
  const GpuBuffer& lights() const { return lightConstants_; }
  const GpuBuffer& constants() const { return sceneConstants_; }

  /// Records the draws. Precondition: rendering with the given formats has begun.
  void draw(const rendergraph::CommandStream& commands, const SceneDrawRequest& request);

 private:
  struct EmitPipeline;
  EmitPipeline& pipelineFor(const SceneDrawRequest& request, bool masked);
  void makeSceneSet(const std::optional<Environment>& environment);
  void bindFrame(VkCommandBuffer commands, const SceneDrawRequest& request, VkPipelineLayout layout);

  GraphBackend& backend_;
  const Device& device_;
  SceneGpu gpu_;
  std::vector<Light> lights_;
  std::vector<VkCullModeFlags> cullModes_;  ///< Of the draws, from the latest viewpoint.
  bool lit_ = false;
  GpuBuffer drawConstants_, lightConstants_, sceneConstants_;  ///< Host-visible; written by setViewpoint().
  GpuImage environmentImage_;
  shared::SceneConstants constants_{};  ///< The environment's part is filled once.
  Unique<VkDescriptorPool> pool_;
  VkDescriptorSetLayout sceneSetLayout_ = VK_NULL_HANDLE;
  VkDescriptorSet sceneSet_ = VK_NULL_HANDLE;
  std::mutex pipelinesMutex_;
  std::vector<std::unique_ptr<EmitPipeline>> pipelines_;
};

}  // namespace lensgraph::engine
