// Recording and submission for the graph.
#include <array>
#include <string>

#include "engine/graph_backend.h"
#include "rendergraph/error.h"

namespace engine {

VkCommandBuffer GraphBackend::beginCommands() {
  descriptors_.reset();
  device_.vk().vkResetQueryPool(device_.handle(), queries_.get(), 0, maxTimestamps());
  return commands_.begin();
}

void GraphBackend::submitAndWait(VkCommandBuffer) {
  try {
    commands_.submitAndWait();
  } catch (const std::exception& error) {
    throw rendergraph::GraphError({{.misuse = rendergraph::Misuse::device,
                                    .pass = {},
                                    .resource = {},
                                    .reason = error.what(),
                                    .remedy = "the device or its driver gave up; try a smaller picture",
                                    .where = std::source_location::current()}});
  }
}

void GraphBackend::barrier(VkCommandBuffer commands, const VkDependencyInfo& dependency) {
  device_.vk().vkCmdPipelineBarrier2(commands, &dependency);
}

void GraphBackend::beginRendering(VkCommandBuffer commands, const VkRenderingInfo& rendering) {
  device_.vk().vkCmdBeginRendering(commands, &rendering);
}
void GraphBackend::endRendering(VkCommandBuffer commands) {
  device_.vk().vkCmdEndRendering(commands);
}

void GraphBackend::beginLabel(VkCommandBuffer commands, std::string_view name) {
  if (vkCmdBeginDebugUtilsLabelEXT == nullptr) return;
  std::array<char, 128> text{};
  name.copy(text.data(), text.size() - 1);
  VkDebugUtilsLabelEXT label{VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT};
  label.pLabelName = text.data();
  vkCmdBeginDebugUtilsLabelEXT(commands, &label);
}
void GraphBackend::endLabel(VkCommandBuffer commands) {
  if (vkCmdEndDebugUtilsLabelEXT != nullptr) vkCmdEndDebugUtilsLabelEXT(commands);
}

std::span<const BindingKind> GraphBackend::kindsOf(std::span<const rendergraph::ResolvedBinding> bindings) {
  kinds_.clear();
  for (const auto& binding : bindings) kinds_.push_back(binding.kind);
  return kinds_;
}

void GraphBackend::writeSet(VkDescriptorSet set, std::span<const rendergraph::ResolvedBinding> bindings) {
  imageInfos_.resize(bindings.size());
  bufferInfos_.resize(bindings.size());
  writes_.resize(bindings.size());
  for (uint32_t i = 0; i < bindings.size(); ++i) {
    const auto& binding = bindings[i];
    const bool isImage = binding.kind == BindingKind::sampledImage || binding.kind == BindingKind::storageImage;
    if (isImage) {
      const bool sampled = binding.kind == BindingKind::sampledImage;
      imageInfos_[i] = {sampled ? pipelines_.sampler(binding.sampler) : VK_NULL_HANDLE, binding.view, binding.layout};
    } else {
      bufferInfos_[i] = {binding.buffer, 0, VK_WHOLE_SIZE};
    }
    writes_[i] = {VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
    writes_[i].dstSet = set;
    writes_[i].dstBinding = i;
    writes_[i].descriptorCount = 1;
    writes_[i].descriptorType = descriptorTypeOf(binding.kind);
    writes_[i].pImageInfo = isImage ? &imageInfos_[i] : nullptr;
    writes_[i].pBufferInfo = isImage ? nullptr : &bufferInfos_[i];
  }
  device_.vk().vkUpdateDescriptorSets(device_.handle(), static_cast<uint32_t>(writes_.size()), writes_.data(), 0,
                                      nullptr);
}

void GraphBackend::bind(VkCommandBuffer commands, VkPipelineBindPoint point, const BoundPipeline& pipeline,
                        std::span<const rendergraph::ResolvedBinding> bindings,
                        std::span<const std::byte> pushConstants) {
  const auto& vk = device_.vk();
  vk.vkCmdBindPipeline(commands, point, pipeline.pipeline);
  if (!bindings.empty()) {
    const VkDescriptorSet set = descriptors_.allocate(pipeline.setLayout);
    writeSet(set, bindings);
    vk.vkCmdBindDescriptorSets(commands, point, pipeline.layout, 0, 1, &set, 0, nullptr);
  }
  if (!pushConstants.empty()) {
    vk.vkCmdPushConstants(commands, pipeline.layout, kAllShaderStages, 0, static_cast<uint32_t>(pushConstants.size()),
                          pushConstants.data());
  }
}

void GraphBackend::dispatch(VkCommandBuffer commands, const rendergraph::ResolvedDispatch& dispatch) {
  const auto& pipeline = pipelines_.compute(dispatch.program, kindsOf(dispatch.bindings), dispatch.specialization);
  bind(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline, dispatch.bindings, dispatch.pushConstants);
  if (dispatch.indirect != VK_NULL_HANDLE) {
    device_.vk().vkCmdDispatchIndirect(commands, dispatch.indirect, dispatch.indirectOffset);
  } else {
    device_.vk().vkCmdDispatch(commands, dispatch.groups.x, dispatch.groups.y, dispatch.groups.z);
  }
}

void GraphBackend::draw(VkCommandBuffer commands, const rendergraph::ResolvedDraw& draw) {
  const auto& pipeline =
      pipelines_.raster(draw.program, kindsOf(draw.bindings), draw.specialization, draw.colorFormats, draw.depthFormat);
  bind(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline, draw.bindings, draw.pushConstants);
  const VkViewport viewport{
      0.0f, 0.0f, static_cast<float>(draw.renderArea.width), static_cast<float>(draw.renderArea.height), 0.0f, 1.0f};
  const VkRect2D scissor{{0, 0}, draw.renderArea};
  device_.vk().vkCmdSetViewport(commands, 0, 1, &viewport);
  device_.vk().vkCmdSetScissor(commands, 0, 1, &scissor);
  device_.vk().vkCmdDraw(commands, draw.vertexCount, draw.instanceCount, 0, 0);
}

void GraphBackend::copyImage(VkCommandBuffer commands, VkImage from, VkImage to, const VkImageCopy& region) {
  device_.vk().vkCmdCopyImage(commands, from, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, to,
                              VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
}

void GraphBackend::copyImageToBuffer(VkCommandBuffer commands, VkImage from, VkBuffer to,
                                     const VkBufferImageCopy& region) {
  device_.vk().vkCmdCopyImageToBuffer(commands, from, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, to, 1, &region);
}

void GraphBackend::copyBuffer(VkCommandBuffer commands, VkBuffer from, VkBuffer to, VkDeviceSize bytes) {
  const VkBufferCopy region{0, 0, bytes};
  device_.vk().vkCmdCopyBuffer(commands, from, to, 1, &region);
}

void GraphBackend::fillBuffer(VkCommandBuffer commands, VkBuffer to, uint32_t word) {
  device_.vk().vkCmdFillBuffer(commands, to, 0, VK_WHOLE_SIZE, word);
}

void GraphBackend::clearImage(VkCommandBuffer commands, VkImage image, const VkClearColorValue& value,
                              const VkImageSubresourceRange& range) {
  device_.vk().vkCmdClearColorImage(commands, image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &value, 1, &range);
}

void GraphBackend::clearDepthImage(VkCommandBuffer commands, VkImage image, float depth,
                                   const VkImageSubresourceRange& range) {
  const VkClearDepthStencilValue value{depth, 0};
  device_.vk().vkCmdClearDepthStencilImage(commands, image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &value, 1, &range);
}

}  // namespace engine
