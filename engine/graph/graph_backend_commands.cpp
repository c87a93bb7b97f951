// Records the graph's commands: barriers, renderings, dispatches, draws, copies, labels and timestamps.
#include <array>
#include <string>

#include "engine/graph/graph_backend.h"
#include "engine/graph/graph_error.h"
#include "engine/vulkan/vulkan_functions.h"

namespace lensgraph::engine {

GraphBackend::CommandStream GraphBackend::beginCommands(RecorderId recorder) {
  return withGraphErrors({}, [&] {
    return CommandStream{recorderOf({VK_NULL_HANDLE, recorder}).pool.begin(), recorder};
  });
}

void GraphBackend::endCommands(const CommandStream& commands) {
  checkForGraph(device_.vk().vkEndCommandBuffer(commands.buffer), "vkEndCommandBuffer");
}

void GraphBackend::barrier(const CommandStream& commands, const VkDependencyInfo& dependency) {
  device_.vk().vkCmdPipelineBarrier2(commands.buffer, &dependency);
}
void GraphBackend::setEvent(const CommandStream& commands, VkEvent event, const VkDependencyInfo& dependency) {
  device_.vk().vkCmdSetEvent2(commands.buffer, event, &dependency);
}
void GraphBackend::waitEvent(const CommandStream& commands, VkEvent event, const VkDependencyInfo& dependency) {
  device_.vk().vkCmdWaitEvents2(commands.buffer, 1, &event, &dependency);
}

void GraphBackend::beginRendering(const CommandStream& commands, const VkRenderingInfo& rendering) {
  device_.vk().vkCmdBeginRendering(commands.buffer, &rendering);
}
void GraphBackend::endRendering(const CommandStream& commands) {
  device_.vk().vkCmdEndRendering(commands.buffer);
}

void GraphBackend::beginLabel(const CommandStream& commands, std::string_view name) {
  const auto& vk = device_.vk();
  if (vk.vkCmdBeginDebugUtilsLabelEXT == nullptr) return;
  std::array<char, 128> text{};
  name.copy(text.data(), text.size() - 1);
  VkDebugUtilsLabelEXT label{VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT};
  label.pLabelName = text.data();
  vk.vkCmdBeginDebugUtilsLabelEXT(commands.buffer, &label);
}
void GraphBackend::endLabel(const CommandStream& commands) {
  const auto& vk = device_.vk();
  if (vk.vkCmdEndDebugUtilsLabelEXT != nullptr) vk.vkCmdEndDebugUtilsLabelEXT(commands.buffer);
}

void GraphBackend::writeTimestamp(const CommandStream& commands, VkPipelineStageFlags2 stage, VkQueryPool pool,
                                  uint32_t slot) {
  device_.vk().vkCmdWriteTimestamp2(commands.buffer, stage, pool, slot);
}

VkDescriptorSet GraphBackend::transientSet(const CommandStream& commands, VkDescriptorSetLayout layout,
                                           std::span<const rendergraph::ResolvedBinding> bindings) {
  return withGraphErrors({}, [&] {
    Recorder& recorder = recorderOf(commands);
    const VkDescriptorSet set = recorder.descriptors.allocate(layout);
    recorder.writer.write(device_, pipelines_, set, bindings);
    return set;
  });
}

void GraphBackend::writeSet(VkDescriptorSet set, std::span<const rendergraph::ResolvedBinding> bindings) {
  SetWriter().write(device_, pipelines_, set, bindings);
}

namespace {

std::span<const BindingKind> kindsOf(std::span<const rendergraph::ResolvedBinding> bindings,
                                     std::vector<BindingKind>& kinds) {
  kinds.clear();
  for (const auto& binding : bindings) kinds.push_back(binding.kind);
  return kinds;
}

}  // namespace

void GraphBackend::bind(const CommandStream& commands, VkPipelineBindPoint point, const BoundPipeline& pipeline,
                        std::span<const rendergraph::ResolvedBinding> bindings,
                        std::span<const std::byte> pushConstants) {
  const auto& vk = device_.vk();
  vk.vkCmdBindPipeline(commands.buffer, point, pipeline.pipeline);
  if (!bindings.empty()) {
    const VkDescriptorSet set = transientSet(commands, pipeline.setLayout, bindings);
    vk.vkCmdBindDescriptorSets(commands.buffer, point, pipeline.layout, 0, 1, &set, 0, nullptr);
  }
  if (!pushConstants.empty()) {
    vk.vkCmdPushConstants(commands.buffer, pipeline.layout, kAllShaderStages, 0,
                          static_cast<uint32_t>(pushConstants.size()), pushConstants.data());
  }
}

void GraphBackend::dispatch(const CommandStream& commands, const rendergraph::ResolvedDispatch& dispatch) {
  const auto kinds = kindsOf(dispatch.bindings, recorderOf(commands).kinds);
  const auto& pipeline = withGraphErrors({}, [&]() -> const BoundPipeline& {
    return pipelines_.compute(dispatch.program, kinds, dispatch.specialization);
  });
  bind(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline, dispatch.bindings, dispatch.pushConstants);
  if (dispatch.indirect != VK_NULL_HANDLE) {
    device_.vk().vkCmdDispatchIndirect(commands.buffer, dispatch.indirect, dispatch.indirectOffset);
  } else {
    device_.vk().vkCmdDispatch(commands.buffer, dispatch.groups.x, dispatch.groups.y, dispatch.groups.z);
  }
}

void GraphBackend::draw(const CommandStream& commands, const rendergraph::ResolvedDraw& draw) {
  const auto kinds = kindsOf(draw.bindings, recorderOf(commands).kinds);
  const auto& pipeline = withGraphErrors({}, [&]() -> const BoundPipeline& {
    return pipelines_.raster(draw.program, kinds, draw.specialization, draw.colorFormats, draw.depthFormat,
                             draw.samples);
  });
  bind(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline, draw.bindings, draw.pushConstants);
  const VkViewport viewport{
      0.0f, 0.0f, static_cast<float>(draw.renderArea.width), static_cast<float>(draw.renderArea.height), 0.0f, 1.0f};
  const VkRect2D scissor{{0, 0}, draw.renderArea};
  device_.vk().vkCmdSetViewport(commands.buffer, 0, 1, &viewport);
  device_.vk().vkCmdSetScissor(commands.buffer, 0, 1, &scissor);
  device_.vk().vkCmdDraw(commands.buffer, draw.vertexCount, draw.instanceCount, 0, 0);
}

void GraphBackend::copyImage(const CommandStream& commands, VkImage from, VkImage to, const VkImageCopy& region) {
  device_.vk().vkCmdCopyImage(commands.buffer, from, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, to,
                              VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
}

void GraphBackend::copyImageToBuffer(const CommandStream& commands, VkImage from, VkBuffer to,
                                     const VkBufferImageCopy& region) {
  device_.vk().vkCmdCopyImageToBuffer(commands.buffer, from, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, to, 1, &region);
}

void GraphBackend::copyBuffer(const CommandStream& commands, VkBuffer from, VkBuffer to, VkDeviceSize bytes) {
  const VkBufferCopy region{0, 0, bytes};
  device_.vk().vkCmdCopyBuffer(commands.buffer, from, to, 1, &region);
}

void GraphBackend::fillBuffer(const CommandStream& commands, VkBuffer to, uint32_t word, VkDeviceSize bytes) {
  device_.vk().vkCmdFillBuffer(commands.buffer, to, 0, bytes, word);
}

void GraphBackend::updateBuffer(const CommandStream& commands, VkBuffer to, VkDeviceSize offset,
                                std::span<const std::byte> bytes) {
  device_.vk().vkCmdUpdateBuffer(commands.buffer, to, offset, bytes.size(), bytes.data());
}

void GraphBackend::clearImage(const CommandStream& commands, VkImage image, const VkClearColorValue& value,
                              const VkImageSubresourceRange& range) {
  device_.vk().vkCmdClearColorImage(commands.buffer, image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &value, 1, &range);
}

void GraphBackend::clearDepthImage(const CommandStream& commands, VkImage image, float depth,
                                   const VkImageSubresourceRange& range) {
  const VkClearDepthStencilValue value{depth, 0};
  device_.vk().vkCmdClearDepthStencilImage(commands.buffer, image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &value, 1,
                                           &range);
}

}  // namespace lensgraph::engine
