// A pass: what it reads and writes, and how it is recorded.
#pragma once

#include <vulkan/vulkan_core.h>

#include <cstddef>
#include <cstdint>
#include <new>
#include <source_location>
#include <type_traits>
#include <utility>

#include "rendergraph/handle.h"
#include "rendergraph/pass_context.h"
#include "rendergraph/pass_kind.h"
#include "rendergraph/resource.h"
#include "rendergraph/usage.h"

namespace lensgraph::rendergraph {

struct Declaration;  // declare/declaration.h: what the graph has noted so far.

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
  friend class ComputePass;  // compute_pass.h
  friend class Graph;
  using Recorder = void (*)(void* recording, PassContext& context);
  using Destroyer = void (*)(void* recording);

  Pass(Declaration& declaration, uint32_t index) : declaration_(&declaration), index_(index) {}
  /// Memory for a recording, and where to hang it.
  void* allocateRecording(std::size_t size, std::size_t alignment);
  void setRecording(void* recording, Recorder recorder, Destroyer destroyer);

  Declaration* declaration_;
  uint32_t index_;
};

template <class Recording>
void Pass::record(Recording recording) {
  void* memory = allocateRecording(sizeof(Recording), alignof(Recording));
  new (memory) Recording(std::move(recording));
  setRecording(
      memory, [](void* self, PassContext& context) { (*static_cast<Recording*>(self))(context); },
      std::is_trivially_destructible_v<Recording> ? nullptr
                                                  : +[](void* self) { static_cast<Recording*>(self)->~Recording(); });
}

}  // namespace lensgraph::rendergraph
