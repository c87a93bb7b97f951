// Pipelines, layouts and samplers, made on first use and kept; VkPipelineCache on disk.
#pragma once

#include <deque>
#include <filesystem>
#include <memory>
#include <shared_mutex>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "engine/vulkan/device.h"
#include "engine/vulkan/vulkan_api.h"
#include "rendergraph/program.h"

namespace lensgraph::engine {

/// The push constant range of every pipeline of the engine: the minimum that Vulkan guarantees, all stages.
inline constexpr uint32_t kPushConstantBytes = 128;

/// Stages that see the push constants of every pipeline layout made here.
inline constexpr VkShaderStageFlags kAllShaderStages = VK_SHADER_STAGE_ALL;

/// What is bound to run a program. Owned by the store.
struct BoundPipeline {
  VkPipeline pipeline = VK_NULL_HANDLE;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  VkDescriptorSetLayout setLayout = VK_NULL_HANDLE;  ///< Of set 0.
};

using BindingKind = rendergraph::Binding::Kind;
/// The descriptor type of a kind of binding; sampled images are combined with their sampler.
VkDescriptorType descriptorTypeOf(BindingKind kind);

/// Thread-safe: known objects are looked up side by side, new ones are made one at a time. The device outlives it.
class PipelineStore {
 public:
  /// `cacheFile` empty: no disk cache. A missing, unreadable or foreign file is ignored; the driver checks its header.
  PipelineStore(const Device& device, std::filesystem::path cacheFile);
  /// Writes the cache file (to a temporary name, then renamed); failing that, says nothing: it is only a cache.
  ~PipelineStore();
  PipelineStore(const PipelineStore&) = delete;
  PipelineStore& operator=(const PipelineStore&) = delete;

  /// The pipeline of a program for these kinds of bindings and specialization constants 0, 1, ….
  const BoundPipeline& compute(const rendergraph::ComputeProgram& program, std::span<const BindingKind> kinds,
                               std::span<const uint32_t> specialization);
  /// The same, for dynamic rendering into attachments of these formats and samples.
  const BoundPipeline& raster(const rendergraph::RasterProgram& program, std::span<const BindingKind> kinds,
                              std::span<const uint32_t> specialization, std::span<const VkFormat> colorFormats,
                              VkFormat depthFormat, VkSampleCountFlagBits samples);

  /// A sampler with these settings, without limits of its own to the levels of detail.
  VkSampler sampler(const rendergraph::SamplerDesc& desc);
  /// A set layout whose binding i has kind i, visible to all stages.
  VkDescriptorSetLayout setLayout(std::span<const BindingKind> kinds);
  /// For pipelines that others make.
  VkPipelineCache cache() const { return cache_.get(); }

 private:
  struct Entry {
    Unique<VkPipelineLayout> layout;
    Unique<VkPipeline> pipeline;
    BoundPipeline bound;
  };
  /// The entry of the key, made by `make` when there is none.
  template <class Make>
  const BoundPipeline& find(const std::string& key, Make&& make);
  Unique<VkPipelineLayout> makeLayout(VkDescriptorSetLayout setLayout);

  const Device& device_;
  std::filesystem::path cacheFile_;
  Unique<VkPipelineCache> cache_;
  std::shared_mutex mutex_;  ///< Of all maps below, whose elements stay where they are.
  std::unordered_map<std::string, Entry> entries_;
  std::unordered_map<std::string, Unique<VkDescriptorSetLayout>> setLayouts_;
  std::deque<std::pair<rendergraph::SamplerDesc, Unique<VkSampler>>> samplers_;
};

/// $XDG_CACHE_HOME/lensgraph/ (or ~/.cache/lensgraph/) and a file name of device and driver; empty without a home.
std::filesystem::path defaultPipelineCacheFile(const Device& device);

}  // namespace lensgraph::engine
