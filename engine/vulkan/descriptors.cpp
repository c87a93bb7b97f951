// Allocates sets from pools of fixed size, adding a pool when all are full, and writes resolved bindings into sets.
#include "engine/vulkan/descriptors.h"

#include "engine/vulkan/vulkan_functions.h"

namespace lensgraph::engine {

void DescriptorRing::reset() {
  for (const auto& pool : pools_) {
    check(device_.vk().vkResetDescriptorPool(device_.handle(), pool.get(), 0), "vkResetDescriptorPool");
  }
  current_ = 0;
}

void DescriptorRing::addPool() {
  constexpr uint32_t kSets = 256;
  const VkDescriptorPoolSize sizes[] = {{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, kSets * 4},
                                        {VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, kSets * 4},
                                        {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kSets * 4},
                                        {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, kSets}};
  VkDescriptorPoolCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
  info.maxSets = kSets;
  info.poolSizeCount = 4;
  info.pPoolSizes = sizes;
  VkDescriptorPool pool = VK_NULL_HANDLE;
  check(device_.vk().vkCreateDescriptorPool(device_.handle(), &info, nullptr, &pool), "vkCreateDescriptorPool");
  pools_.emplace_back(device_.handle(), pool, device_.vk().vkDestroyDescriptorPool);
}

VkDescriptorSet DescriptorRing::allocate(VkDescriptorSetLayout layout) {
  for (;;) {
    const bool fresh = current_ == pools_.size();
    if (fresh) addPool();
    VkDescriptorSetAllocateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
    info.descriptorPool = pools_[current_].get();
    info.descriptorSetCount = 1;
    info.pSetLayouts = &layout;
    VkDescriptorSet set = VK_NULL_HANDLE;
    const VkResult result = device_.vk().vkAllocateDescriptorSets(device_.handle(), &info, &set);
    if (result == VK_SUCCESS) return set;
    // A pool that is full for one set may be full for all: go on to the next. A fresh one that fails is an error.
    if (fresh) check(result, "vkAllocateDescriptorSets");
    ++current_;
  }
}

void SetWriter::write(const Device& device, PipelineStore& pipelines, VkDescriptorSet set,
                      std::span<const rendergraph::ResolvedBinding> bindings) {
  images_.resize(bindings.size());
  buffers_.resize(bindings.size());
  writes_.resize(bindings.size());
  for (uint32_t i = 0; i < bindings.size(); ++i) {
    const auto& binding = bindings[i];
    const bool isImage = binding.kind == BindingKind::sampledImage || binding.kind == BindingKind::storageImage;
    if (isImage) {
      const bool sampled = binding.kind == BindingKind::sampledImage;
      images_[i] = {sampled ? pipelines.sampler(binding.sampler) : VK_NULL_HANDLE, binding.view, binding.layout};
    } else {
      buffers_[i] = {binding.buffer, 0, VK_WHOLE_SIZE};
    }
    writes_[i] = {VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
    writes_[i].dstSet = set;
    writes_[i].dstBinding = i;
    writes_[i].descriptorCount = 1;
    writes_[i].descriptorType = descriptorTypeOf(binding.kind);
    writes_[i].pImageInfo = isImage ? &images_[i] : nullptr;
    writes_[i].pBufferInfo = isImage ? nullptr : &buffers_[i];
  }
  device.vk().vkUpdateDescriptorSets(device.handle(), static_cast<uint32_t>(writes_.size()), writes_.data(), 0,
                                     nullptr);
}

}  // namespace lensgraph::engine
