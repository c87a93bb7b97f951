// Pools of descriptor sets.
#include "engine/descriptors.h"

namespace engine {

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

}  // namespace engine
