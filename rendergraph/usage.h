// How a pass uses a resource. declare/access_table.h says what each usage means to Vulkan.
#pragma once

#include <cstdint>

namespace lensgraph::rendergraph {

enum class Usage : uint8_t {
  sampled,              ///< Image read through a sampler or texelFetch.
  storage,              ///< Image or buffer read/written by shaders; image layout GENERAL.
  colorAttachment,      ///< Image written (and read, when loaded or blended) as colour attachment.
  depthAttachment,      ///< Image tested and written as depth attachment.
  depthReadOnly,        ///< Depth attachment that is tested, not written; may be sampled in the same pass.
  transferSource,       ///< Source of copy or blit.
  transferDestination,  ///< Destination of copy, blit, clear, fill.
  uniform,              ///< Uniform buffer.
  indirect,             ///< Arguments of an indirect draw or dispatch.
  vertex,               ///< Vertex buffer.
  index,                ///< Index buffer.
  host,                 ///< Read or written by the host after or before the frame.
};

/// Whether an access keeps, changes or replaces content.
enum class AccessMode : uint8_t {
  read,
  write,   ///< Replaces the content of the whole range; what was there is not needed.
  modify,  ///< Reads and writes (blending, atomics, partial writes).
};

}  // namespace lensgraph::rendergraph
