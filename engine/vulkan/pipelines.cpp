// Looks up pipelines, layouts and samplers by their key, and makes those that are not there yet.
#include "engine/vulkan/pipelines.h"

#include <array>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iterator>
#include <mutex>

#include "engine/vulkan/raster_pipeline.h"
#include "engine/vulkan/shader_module.h"
#include "engine/vulkan/vulkan_functions.h"

namespace lensgraph::engine {
namespace {

std::vector<char> readFile(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) return {};
  return {std::istreambuf_iterator<char>(in), {}};
}

template <class T>
void append(std::string& key, const T& value) {
  key.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// The thread's own key, begun; reused, so that a lookup allocates nothing.
std::string& beginKey(const void* program, std::span<const BindingKind> kinds,
                      std::span<const uint32_t> specialization) {
  thread_local std::string key;
  key.clear();
  append(key, program);
  append(key, static_cast<uint32_t>(kinds.size()));
  key.append(reinterpret_cast<const char*>(kinds.data()), kinds.size_bytes());
  append(key, static_cast<uint32_t>(specialization.size()));
  key.append(reinterpret_cast<const char*>(specialization.data()), specialization.size_bytes());
  return key;
}

/// Specialization constants 0, 1, … from words.
struct Specialization {
  std::array<VkSpecializationMapEntry, 16> entries;
  VkSpecializationInfo info{};

  explicit Specialization(std::span<const uint32_t> words) {
    if (words.size() > entries.size()) throwDeviceError("more than 16 specialization constants", "use push constants");
    for (uint32_t i = 0; i < words.size(); ++i) entries[i] = {i, i * 4, 4};
    info = {static_cast<uint32_t>(words.size()), entries.data(), words.size_bytes(), words.data()};
  }
};

}  // namespace

VkDescriptorType descriptorTypeOf(BindingKind kind) {
  switch (kind) {
    case BindingKind::sampledImage:
      return VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    case BindingKind::storageImage:
      return VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
    case BindingKind::storageBuffer:
      return VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    case BindingKind::uniformBuffer:
      return VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
  }
  return VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
}

std::filesystem::path defaultPipelineCacheFile(const Device& device) {
  const char* cache = std::getenv("XDG_CACHE_HOME");
  const char* home = std::getenv("HOME");
  std::filesystem::path folder;
  if (cache != nullptr && *cache != '\0')
    folder = cache;
  else if (home != nullptr && *home != '\0')
    folder = std::filesystem::path(home) / ".cache";
  else
    return {};
  const auto& description = device.description();
  const auto hash = std::hash<std::string>{}(description.name + description.driver);
  return folder / "lensgraph" / ("pipelines-" + std::to_string(hash) + ".bin");
}

PipelineStore::PipelineStore(const Device& device, std::filesystem::path cacheFile)
    : device_(device), cacheFile_(std::move(cacheFile)) {
  const auto data = cacheFile_.empty() ? std::vector<char>{} : readFile(cacheFile_);
  VkPipelineCacheCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO};
  info.initialDataSize = data.size();
  info.pInitialData = data.data();
  VkPipelineCache cache = VK_NULL_HANDLE;
  check(device.vk().vkCreatePipelineCache(device.handle(), &info, nullptr, &cache), "vkCreatePipelineCache");
  cache_ = {device.handle(), cache, device.vk().vkDestroyPipelineCache};
}

PipelineStore::~PipelineStore() {
  if (cacheFile_.empty()) return;
  std::size_t size = 0;
  const auto& vk = device_.vk();
  if (vk.vkGetPipelineCacheData(device_.handle(), cache_.get(), &size, nullptr) != VK_SUCCESS) return;
  std::vector<char> data(size);
  if (vk.vkGetPipelineCacheData(device_.handle(), cache_.get(), &size, data.data()) != VK_SUCCESS) return;
  std::error_code ignored;
  std::filesystem::create_directories(cacheFile_.parent_path(), ignored);
  auto temporary = cacheFile_;
  temporary += "." + std::to_string(reinterpret_cast<std::uintptr_t>(this)) + ".tmp";
  std::ofstream out(temporary, std::ios::binary);
  out.write(data.data(), static_cast<std::streamsize>(size));
  out.close();
  if (out) std::filesystem::rename(temporary, cacheFile_, ignored);
  std::filesystem::remove(temporary, ignored);
}

VkDescriptorSetLayout PipelineStore::setLayout(std::span<const BindingKind> kinds) {
  const std::string key(reinterpret_cast<const char*>(kinds.data()), kinds.size_bytes());
  {
    const std::shared_lock lock(mutex_);
    if (const auto found = setLayouts_.find(key); found != setLayouts_.end() && found->second) {
      return found->second.get();
    }
  }
  const std::unique_lock lock(mutex_);
  auto& slot = setLayouts_[key];
  if (!slot) {
    std::vector<VkDescriptorSetLayoutBinding> bindings;
    for (uint32_t i = 0; i < kinds.size(); ++i) {
      bindings.push_back({i, descriptorTypeOf(kinds[i]), 1, kAllShaderStages, nullptr});
    }
    VkDescriptorSetLayoutCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
    info.bindingCount = static_cast<uint32_t>(bindings.size());
    info.pBindings = bindings.data();
    VkDescriptorSetLayout layout = VK_NULL_HANDLE;
    check(device_.vk().vkCreateDescriptorSetLayout(device_.handle(), &info, nullptr, &layout),
          "vkCreateDescriptorSetLayout");
    slot = {device_.handle(), layout, device_.vk().vkDestroyDescriptorSetLayout};
  }
  return slot.get();
}

Unique<VkPipelineLayout> PipelineStore::makeLayout(VkDescriptorSetLayout set) {
  const VkPushConstantRange range{kAllShaderStages, 0, kPushConstantBytes};
  VkPipelineLayoutCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
  info.setLayoutCount = 1;
  info.pSetLayouts = &set;
  info.pushConstantRangeCount = 1;
  info.pPushConstantRanges = &range;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  check(device_.vk().vkCreatePipelineLayout(device_.handle(), &info, nullptr, &layout), "vkCreatePipelineLayout");
  return {device_.handle(), layout, device_.vk().vkDestroyPipelineLayout};
}

template <class Make>
const BoundPipeline& PipelineStore::find(const std::string& key, Make&& make) {
  {
    const std::shared_lock lock(mutex_);
    if (const auto found = entries_.find(key); found != entries_.end()) return found->second.bound;
  }
  // Made without the lock: a pipeline takes long, and two threads that make the same one are rare.
  Entry made = make();
  const std::unique_lock lock(mutex_);
  return entries_.try_emplace(key, std::move(made)).first->second.bound;
}

const BoundPipeline& PipelineStore::compute(const rendergraph::ComputeProgram& program,
                                            std::span<const BindingKind> kinds,
                                            std::span<const uint32_t> specialization) {
  return find(beginKey(&program, kinds, specialization), [&] {
    Entry entry;
    entry.bound.setLayout = setLayout(kinds);
    entry.layout = makeLayout(entry.bound.setLayout);
    const auto module = makeShaderModule(device_, program.shader, program.name);
    const Specialization constants(specialization);
    VkComputePipelineCreateInfo info{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
    info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.module = module.get();
    info.stage.pName = "main";
    info.stage.pSpecializationInfo = &constants.info;
    info.layout = entry.layout.get();
    VkPipeline pipeline = VK_NULL_HANDLE;
    check(device_.vk().vkCreateComputePipelines(device_.handle(), cache_.get(), 1, &info, nullptr, &pipeline),
          std::string("compute pipeline ") + program.name);
    entry.pipeline = {device_.handle(), pipeline, device_.vk().vkDestroyPipeline};
    device_.setName(VK_OBJECT_TYPE_PIPELINE, reinterpret_cast<uint64_t>(pipeline), program.name);
    entry.bound.pipeline = pipeline;
    entry.bound.layout = entry.layout.get();
    return entry;
  });
}

const BoundPipeline& PipelineStore::raster(const rendergraph::RasterProgram& program,
                                           std::span<const BindingKind> kinds, std::span<const uint32_t> specialization,
                                           std::span<const VkFormat> colorFormats, VkFormat depthFormat,
                                           VkSampleCountFlagBits samples) {
  std::string& key = beginKey(&program, kinds, specialization);
  key.append(reinterpret_cast<const char*>(colorFormats.data()), colorFormats.size_bytes());
  append(key, depthFormat);
  append(key, samples);
  return find(key, [&] {
    Entry entry;
    entry.bound.setLayout = setLayout(kinds);
    entry.layout = makeLayout(entry.bound.setLayout);
    const Specialization constants(specialization);
    RasterPipelineDesc desc;
    desc.name = program.name;
    desc.vertex = program.vertex;
    desc.geometry = program.geometry;
    desc.fragment = program.fragment;
    desc.state = program.state;
    desc.specialization = &constants.info;
    desc.colorFormats = colorFormats;
    desc.depthFormat = depthFormat;
    desc.samples = samples;
    entry.pipeline = makeRasterPipeline(device_, cache_.get(), entry.layout.get(), desc);
    entry.bound.pipeline = entry.pipeline.get();
    entry.bound.layout = entry.layout.get();
    return entry;
  });
}

VkSampler PipelineStore::sampler(const rendergraph::SamplerDesc& desc) {
  const auto find = [&]() -> VkSampler {
    for (const auto& [known, sampler] : samplers_) {
      if (known == desc) return sampler.get();
    }
    return VK_NULL_HANDLE;
  };
  {
    const std::shared_lock lock(mutex_);
    if (const VkSampler found = find(); found != VK_NULL_HANDLE) return found;
  }
  const std::unique_lock lock(mutex_);
  if (const VkSampler found = find(); found != VK_NULL_HANDLE) return found;
  VkSamplerCreateInfo info{VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO};
  info.magFilter = info.minFilter = desc.filter;
  info.mipmapMode = desc.mipmap;
  info.addressModeU = info.addressModeV = info.addressModeW = desc.address;
  info.maxLod = VK_LOD_CLAMP_NONE;
  VkSampler sampler = VK_NULL_HANDLE;
  check(device_.vk().vkCreateSampler(device_.handle(), &info, nullptr, &sampler), "vkCreateSampler");
  samplers_.emplace_back(desc, Unique<VkSampler>(device_.handle(), sampler, device_.vk().vkDestroySampler));
  return sampler;
}

}  // namespace lensgraph::engine
