// Hands out command buffers, submits one-off work and waits for it, and copies bytes to the device through staging
// memory.
#include "engine/vulkan/command_buffers.h"

#include <algorithm>
#include <cstring>
#include <vector>

#include "engine/vulkan/vulkan_functions.h"

namespace lensgraph::engine {
namespace {

/// One image barrier over all mips and layers of a colour image.
void transition(const Device& device, VkCommandBuffer commands, const GpuImage& image, VkImageLayout from,
                VkImageLayout to, VkPipelineStageFlags2 fromStage, VkAccessFlags2 fromAccess,
                VkPipelineStageFlags2 toStage, VkAccessFlags2 toAccess) {
  VkImageMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
  barrier.srcStageMask = fromStage;
  barrier.srcAccessMask = fromAccess;
  barrier.dstStageMask = toStage;
  barrier.dstAccessMask = toAccess;
  barrier.oldLayout = from;
  barrier.newLayout = to;
  barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.image = image.image.get();
  barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, VK_REMAINING_MIP_LEVELS, 0, VK_REMAINING_ARRAY_LAYERS};
  VkDependencyInfo dependency{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
  dependency.imageMemoryBarrierCount = 1;
  dependency.pImageMemoryBarriers = &barrier;
  device.vk().vkCmdPipelineBarrier2(commands, &dependency);
}

GpuBuffer stage(const Device& device, std::span<const std::byte> bytes) {
  auto staging =
      makeBuffer(device, bytes.size(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT, rendergraph::MemoryKind::upload, "staging");
  std::memcpy(staging.block.address, bytes.data(), bytes.size());
  return staging;
}

/// One region per mip, one after the other in the buffer.
std::vector<VkBufferImageCopy> mipRegions(const rendergraph::ImageDesc& desc) {
  std::vector<VkBufferImageCopy> regions;
  VkDeviceSize offset = 0;
  for (uint32_t mip = 0; mip < desc.mips; ++mip) {
    const uint32_t width = std::max(desc.width >> mip, 1u), height = std::max(desc.height >> mip, 1u);
    VkBufferImageCopy region{};
    region.bufferOffset = offset;
    region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, mip, 0, 1};
    region.imageExtent = {width, height, 1};
    regions.push_back(region);
    offset += VkDeviceSize{width} * height * rendergraph::texelSize(desc.format);
  }
  return regions;
}

}  // namespace

CommandPool::CommandPool(const Device& device, uint32_t queue, std::string_view name) : device_(device), name_(name) {
  VkCommandPoolCreateInfo info{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
  info.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
  info.queueFamilyIndex = device.queues()[queue].family;
  VkCommandPool pool = VK_NULL_HANDLE;
  check(device.vk().vkCreateCommandPool(device.handle(), &info, nullptr, &pool), "vkCreateCommandPool");
  pool_ = {device.handle(), pool, device.vk().vkDestroyCommandPool};
  device.setName(VK_OBJECT_TYPE_COMMAND_POOL, reinterpret_cast<uint64_t>(pool), name);
}

VkCommandBuffer CommandPool::begin() {
  const auto& vk = device_.vk();
  if (used_ == buffers_.size()) {
    VkCommandBufferAllocateInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
    info.commandPool = pool_.get();
    info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    info.commandBufferCount = 1;
    buffers_.reserve(used_ + 1);
    VkCommandBuffer made = VK_NULL_HANDLE;
    check(vk.vkAllocateCommandBuffers(device_.handle(), &info, &made), "vkAllocateCommandBuffers");
    device_.setName(VK_OBJECT_TYPE_COMMAND_BUFFER, reinterpret_cast<uint64_t>(made),
                    name_ + " #" + std::to_string(used_));
    buffers_.push_back(made);
  }
  VkCommandBufferBeginInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
  info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  const VkCommandBuffer commands = buffers_[used_++];
  check(vk.vkBeginCommandBuffer(commands, &info), "vkBeginCommandBuffer");
  return commands;
}

void CommandPool::reset() {
  check(device_.vk().vkResetCommandPool(device_.handle(), pool_.get(), 0), "vkResetCommandPool");
  used_ = 0;
}

void runOnce(const Device& device, const std::function<void(VkCommandBuffer)>& record) {
  const auto& vk = device.vk();
  CommandPool pool(device, 0, "one-off");
  const VkFenceCreateInfo fenceInfo{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO, nullptr, 0};
  VkFence fence = VK_NULL_HANDLE;
  check(vk.vkCreateFence(device.handle(), &fenceInfo, nullptr, &fence), "vkCreateFence");
  const Unique<VkFence> owned(device.handle(), fence, vk.vkDestroyFence);
  VkCommandBufferSubmitInfo commandInfo{VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO};
  commandInfo.commandBuffer = pool.begin();
  record(commandInfo.commandBuffer);
  check(vk.vkEndCommandBuffer(commandInfo.commandBuffer), "vkEndCommandBuffer");
  VkSubmitInfo2 submit{VK_STRUCTURE_TYPE_SUBMIT_INFO_2};
  submit.commandBufferInfoCount = 1;
  submit.pCommandBufferInfos = &commandInfo;
  check(device.submit(0, submit, fence), "vkQueueSubmit2");
  check(vk.vkWaitForFences(device.handle(), 1, &fence, VK_TRUE, UINT64_MAX), "vkWaitForFences");
}

void upload(const Device& device, const GpuBuffer& target, std::span<const std::byte> bytes) {
  if (bytes.empty()) return;
  const auto staging = stage(device, bytes);
  runOnce(device, [&](VkCommandBuffer commands) {
    const VkBufferCopy region{0, 0, bytes.size()};
    device.vk().vkCmdCopyBuffer(commands, staging.buffer.get(), target.buffer.get(), 1, &region);
  });
}

void upload(const Device& device, const GpuImage& target, std::span<const std::byte> texels) {
  const auto staging = stage(device, texels);
  runOnce(device, [&](VkCommandBuffer commands) {
    transition(device, commands, target, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
               VK_PIPELINE_STAGE_2_NONE, 0, VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT);
    const auto regions = mipRegions(target.desc);
    device.vk().vkCmdCopyBufferToImage(commands, staging.buffer.get(), target.image.get(),
                                       VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, static_cast<uint32_t>(regions.size()),
                                       regions.data());
    transition(device, commands, target, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
               VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
               VK_ACCESS_2_SHADER_READ_BIT);
  });
}

}  // namespace lensgraph::engine
