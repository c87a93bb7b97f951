// Shaders as the graph sees them: SPIR-V, fixed state, and the resources bound to a call.
//
// Bindings are positional: element i of the list is binding i of descriptor set 0, and the descriptor set layout
// follows from the kinds in the list. So a technique needs no Vulkan objects of its own, and a backend caches
// pipelines by (program, specialization, kinds of bindings, attachment formats).
#pragma once

#include <vulkan/vulkan_core.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

#include "rendergraph/handle.h"
#include "rendergraph/resource.h"

namespace lensgraph::rendergraph {

using SpirV = std::span<const uint32_t>;

/// A compute shader. Must have static storage duration: its address is its identity.
struct ComputeProgram {
  const char* name = "";
  SpirV shader;
};

struct RasterState {
  VkPrimitiveTopology topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
  VkCullModeFlags cull = VK_CULL_MODE_NONE;
  bool depthTest = false;
  bool depthWrite = false;
  VkCompareOp depthCompare = VK_COMPARE_OP_GREATER;  ///< Reversed depth: nearer is greater.
  bool blend = false;                                ///< Premultiplied over, all attachments.
  bool operator==(const RasterState&) const = default;
};

/// Vertex, optional geometry and fragment shader without vertex input (full-screen work). Static, as above.
struct RasterProgram {
  const char* name = "";
  SpirV vertex;
  SpirV geometry;
  SpirV fragment;
  RasterState state;
};

struct SamplerDesc {
  VkFilter filter = VK_FILTER_LINEAR;
  VkSamplerMipmapMode mipmap = VK_SAMPLER_MIPMAP_MODE_NEAREST;
  VkSamplerAddressMode address = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
  bool operator==(const SamplerDesc&) const = default;
};

/// One texel, as it is.
inline constexpr SamplerDesc kNearest{.filter = VK_FILTER_NEAREST};

/// One resource bound to a call. Make it with sampled(), storage(), uniform().
struct Binding {
  enum class Kind : uint8_t { sampledImage, storageImage, storageBuffer, uniformBuffer };
  Kind kind = Kind::storageBuffer;
  Image image;
  Subresources range;
  VkImageViewType viewType = VK_IMAGE_VIEW_TYPE_2D;
  SamplerDesc sampler;
  Buffer buffer;
};

inline Binding sampled(Image image, SamplerDesc sampler = {}, Subresources range = {},
                       VkImageViewType viewType = VK_IMAGE_VIEW_TYPE_2D) {
  return {.kind = Binding::Kind::sampledImage,
          .image = image,
          .range = range,
          .viewType = viewType,
          .sampler = sampler,
          .buffer = {}};
}
/// A storage image; one mip. `viewType` 2D_ARRAY for image2DArray.
inline Binding storage(Image image, Subresources range = mip(0), VkImageViewType viewType = VK_IMAGE_VIEW_TYPE_2D) {
  return {.kind = Binding::Kind::storageImage,
          .image = image,
          .range = range,
          .viewType = viewType,
          .sampler = {},
          .buffer = {}};
}
inline Binding storage(Buffer buffer) {
  return {.kind = Binding::Kind::storageBuffer, .image = {}, .range = {}, .sampler = {}, .buffer = buffer};
}
inline Binding uniform(Buffer buffer) {
  return {.kind = Binding::Kind::uniformBuffer, .image = {}, .range = {}, .sampler = {}, .buffer = buffer};
}

/// The bytes of a plain struct, for push constants (at most 128 bytes everywhere). The object must outlive the call.
template <class T>
std::span<const std::byte> bytesOf(const T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  return std::as_bytes(std::span<const T, 1>(&value, 1));
}

struct Groups {
  uint32_t x = 1, y = 1, z = 1;
};
/// Work groups of `tile`×`tile` invocations that cover the extent.
constexpr Groups groupsFor(VkExtent2D extent, uint32_t tile) {
  return {(extent.width + tile - 1) / tile, (extent.height + tile - 1) / tile, 1};
}

/// One dispatch. Spans need to live only until the call returns.
struct Dispatch {
  const ComputeProgram& program;
  std::span<const Binding> bindings;
  std::span<const std::byte> pushConstants = {};
  std::span<const uint32_t> specialization = {};  ///< Value of constant_id 0, 1, …
  Groups groups;
  Buffer indirect = {};             ///< When set, the group counts are read from it.
  VkDeviceSize indirectOffset = 0;  ///< Bytes.
};

/// One draw without vertex buffers.
struct Draw {
  const RasterProgram& program;
  std::span<const Binding> bindings;
  std::span<const std::byte> pushConstants = {};
  std::span<const uint32_t> specialization = {};
  uint32_t vertexCount = 3;
  uint32_t instanceCount = 1;
};

}  // namespace lensgraph::rendergraph
