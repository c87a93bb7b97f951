// A pass: what it reads and writes, and how it is recorded.
#pragma once

#include <vulkan/vulkan_core.h>

#include <cstddef>
#include <cstdint>
#include <source_location>
#include <span>
#include <string_view>

#include "rendergraph/command_stream.h"
#include "rendergraph/declare/access_table.h"
#include "rendergraph/handle.h"
#include "rendergraph/program.h"
#include "rendergraph/resource.h"

namespace lensgraph::rendergraph {

class Graph;
class StepRecorder;

enum class PassKind : uint8_t {
  raster,  ///< Draws into attachments (dynamic rendering is begun and ended around the recording).
  compute,
  transfer,  ///< Copies, clears, fills.
  host,      ///< Runs on the host between submissions.
};

/// Which queue a pass would like; a device without it uses the graphics queue.
enum class QueuePreference : uint8_t { graphics, asyncCompute, transfer };

enum class LoadOp : uint8_t {
  clear,
  load,      ///< Keep what is there: the access is a modify.
  dontCare,  ///< Every texel will be written.
};

struct ColorAttachment {
  LoadOp load = LoadOp::clear;
  VkClearColorValue clear = {};
  Subresources range = mip(0);  ///< One mip; several layers make layered rendering.
};

struct DepthAttachment {
  LoadOp load = LoadOp::clear;
  float clear = 0.0f;  ///< 0 is infinity in reversed depth.
  Subresources range = mip(0);
};

/// What a recording may touch. Lives only during the recording call; do not keep it.
/// Every resource given to it must have been declared by the pass, else GraphError (undeclaredAccess).
/// When the host asks for several recording threads, recordings of different passes run at once: each may use its own
/// context and captures freely, and must guard whatever it shares with the recordings of other passes.
class PassContext {
 public:
  PassContext(StepRecorder& recorder, uint32_t pass) : recorder_(recorder), pass_(pass) {}

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
  struct Inside;
  StepRecorder& recorder_;
  uint32_t pass_;
};

/// Declares one pass. Returned by Graph::addPass; a light reference that must not outlive the graph.
/// Reads take the latest version of a handle; writes return the next one. Errors are GraphErrors, see error.h.
class Pass {
 public:
  using Location = std::source_location;

  /// Reads through sampler or texelFetch. `stages` 0: all shader stages that the kind of pass has
  /// (compute; vertex, geometry and fragment for raster).
  void sample(Image image, Subresources range = {}, VkPipelineStageFlags2 stages = 0,
              Location where = Location::current());
  /// Any other read. For storage images and buffers, uniform, transfer, indirect, vertex, index.
  void read(Image image, Usage usage, Subresources range = {}, VkPipelineStageFlags2 stages = 0,
            Location where = Location::current());
  void read(Buffer buffer, Usage usage, VkPipelineStageFlags2 stages = 0, Location where = Location::current());
  /// Replaces the content of the range; other subresources keep theirs. The result must be used from here on.
  [[nodiscard]] Image write(Image image, Usage usage, Subresources range = {}, VkPipelineStageFlags2 stages = 0,
                            Location where = Location::current());
  [[nodiscard]] Buffer write(Buffer buffer, Usage usage, VkPipelineStageFlags2 stages = 0,
                             Location where = Location::current());
  /// Reads and writes: atomics, partial writes, accumulation in place.
  [[nodiscard]] Image modify(Image image, Usage usage, Subresources range = {}, VkPipelineStageFlags2 stages = 0,
                             Location where = Location::current());
  [[nodiscard]] Buffer modify(Buffer buffer, Usage usage, VkPipelineStageFlags2 stages = 0,
                              Location where = Location::current());
  /// Next colour attachment, in order of calls. Raster passes only. All attachments have the same size.
  [[nodiscard]] Image color(Image image, const ColorAttachment& attachment = {}, Location where = Location::current());
  /// Receives the mean of the samples of the colour attachment declared just before it, which has several samples
  /// where this image has one; same format, size and layers.
  [[nodiscard]] Image resolve(Image target, Subresources range = mip(0), Location where = Location::current());
  /// The depth attachment, tested and written.
  [[nodiscard]] Image depth(Image image, const DepthAttachment& attachment = {}, Location where = Location::current());
  /// The depth attachment, tested only.
  void depthReadOnly(Image image, Subresources range = mip(0), Location where = Location::current());
  /// Render area of a raster pass without attachments (fragment stores only), px.
  void renderArea(VkExtent2D extent, uint32_t layers = 1);

  /// With a false condition the pass is left out as if it had not been declared: what its writes return is the content
  /// from before, so that a chain of passes needs no branches around those that may be missing. Call it before the
  /// pass's accesses. Default: true.
  void onlyIf(bool condition);
  /// Never culled, whatever becomes of its outputs (it has an effect that the graph does not see).
  void sideEffect();
  void prefer(QueuePreference queue);

  /// The recording: callable as void(PassContext&). It is copied into the graph's arena and destroyed by
  /// Graph::reset(); what it references must live until the frame has been recorded.
  template <class Recording>
  void record(Recording recording);

 private:
  friend class Graph;
  Pass(Graph& graph, uint32_t index) : graph_(&graph), index_(index) {}
  Graph* graph_;
  uint32_t index_;
};

}  // namespace lensgraph::rendergraph
