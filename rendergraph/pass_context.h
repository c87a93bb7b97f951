// What a recording may do with the resources that its pass declared.
#pragma once

#include <vulkan/vulkan_core.h>

#include <cstddef>
#include <cstdint>
#include <span>

#include "rendergraph/command_stream.h"
#include "rendergraph/handle.h"
#include "rendergraph/program.h"
#include "rendergraph/resource.h"

namespace lensgraph::rendergraph {

struct StepState;  // The executor's own.

/// What a recording may touch. Lives only during the recording call; do not keep it.
/// Every resource given to it must have been declared by the pass, else GraphError (undeclaredAccess).
/// When the host asks for several recording threads, recordings of different passes run at once: each may use its own
/// context and captures freely, and must guard whatever it shares with the recordings of other passes.
class PassContext {
 public:
  /// For hosts that record Vulkan themselves. State that a recording sets is not restored for the next pass.
  VkCommandBuffer commandBuffer() const { return commands().buffer; }
  /// The same with the backend's recorder, for transient objects of the backend's own kind. Null in a host pass.
  CommandStream commands() const;
  VkImage image(Image image) const;
  VkImageView view(Image image, Subresources range = {}, VkImageViewType type = VK_IMAGE_VIEW_TYPE_2D) const;
  VkBuffer buffer(Buffer buffer) const;
  /// Host pass: content of an upload or readback buffer that the pass declared with Usage::host.
  std::span<std::byte> mapped(Buffer buffer) const;
  /// Size of the image at a mip.
  VkExtent2D extent(Image image, uint32_t mipLevel = 0) const;
  /// Formats of this raster pass's attachments, to make pipelines for it.
  std::span<const VkFormat> colorFormats() const;
  VkFormat depthFormat() const;           ///< UNDEFINED without depth attachment.
  VkSampleCountFlagBits samples() const;  ///< Of the attachments.

  void dispatch(const Dispatch& dispatch);
  void draw(const Draw& draw);
  /// Copies the range that the pass declared as transferSource to the one declared as transferDestination. Both have
  /// the same extents, number of mips and layers, and texel size.
  void copyImage(Image from, Image to);
  /// First mip and layer of the range declared as transferSource, in tightly packed rows.
  void copyImageToBuffer(Image from, Buffer to);
  void copyBuffer(Buffer from, Buffer to, VkDeviceSize bytes);
  /// The first `bytes` of it, a multiple of 4; by default all.
  void fillBuffer(Buffer to, uint32_t word, VkDeviceSize bytes = VK_WHOLE_SIZE);
  /// Writes bytes to the start of a buffer declared as transferDestination: a multiple of 4, no more than the buffer
  /// holds. They travel in the command buffer and are copied by the call: meant for tables of some kilobytes.
  void updateBuffer(Buffer to, std::span<const std::byte> bytes);
  /// Clears the range declared as transferDestination; a depth image to the value's first component.
  void clearImage(Image to, const VkClearColorValue& value);

 private:
  friend class StepRecorder;  // Makes one for each call of a recording.
  struct Inside;
  PassContext(StepState& step, uint32_t pass) : step_(step), pass_(pass) {}
  StepState& step_;
  uint32_t pass_;
};

}  // namespace lensgraph::rendergraph
