// The result of compiling a declaration: plain data, equal for equal input, printable, testable without a device.
//
// Indices refer to the declaration (resources, passes). Nothing here is a Vulkan object.
#pragma once

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "rendergraph/resource.h"

namespace rendergraph {

/// A use of a resource that a barrier waits for, or that waits for it.
struct AccessPoint {
  static constexpr uint32_t kOutside = std::numeric_limits<uint32_t>::max();
  uint32_t pass = kOutside;  ///< kOutside: the host, before or after the graph.
  VkPipelineStageFlags2 stages = 0;
  VkAccessFlags2 access = 0;
  bool operator==(const AccessPoint&) const = default;
};

/// Why a barrier is there.
enum class BarrierReason : uint8_t { readAfterWrite, writeAfterRead, writeAfterWrite, layout, alias };

/// `to` covers every use that the barrier serves: a run of reads by several passes waits once, before the first.
struct ImageBarrier {
  uint32_t resource = 0;
  Subresources range = {};  ///< Resolved: counts are numbers, aspects are set.
  AccessPoint from = {}, to = {};
  VkImageLayout oldLayout = VK_IMAGE_LAYOUT_UNDEFINED;
  VkImageLayout newLayout = VK_IMAGE_LAYOUT_UNDEFINED;
  BarrierReason reason = BarrierReason::layout;
  bool operator==(const ImageBarrier&) const = default;
};

struct BufferBarrier {
  uint32_t resource = 0;
  AccessPoint from = {}, to = {};
  BarrierReason reason = BarrierReason::readAfterWrite;
  bool operator==(const BufferBarrier&) const = default;
};

/// All barriers before one pass, given to Vulkan in one vkCmdPipelineBarrier2.
struct BarrierBatch {
  std::vector<ImageBarrier> images;
  std::vector<BufferBarrier> buffers;
  bool empty() const { return images.empty() && buffers.empty(); }
  bool operator==(const BarrierBatch&) const = default;
};

struct PlannedAttachment {
  uint32_t resource = 0;
  Subresources range;
  VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
  VkAttachmentLoadOp load = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
  VkAttachmentStoreOp store = VK_ATTACHMENT_STORE_OP_STORE;
  bool operator==(const PlannedAttachment&) const = default;
};

struct PlannedPass {
  uint32_t pass = 0;   ///< Index in the declaration.
  uint32_t queue = 0;  ///< Index among the device's queues.
  BarrierBatch before;
  // Raster passes:
  std::vector<PlannedAttachment> colors;
  std::vector<PlannedAttachment> depth;  ///< Zero or one.
  VkExtent2D renderArea = {0, 0};
  uint32_t renderLayers = 1;
  bool operator==(const PlannedPass& other) const {
    return pass == other.pass && queue == other.queue && before == other.before && colors == other.colors &&
           depth == other.depth && renderArea.width == other.renderArea.width &&
           renderArea.height == other.renderArea.height && renderLayers == other.renderLayers;
  }
};

/// A block of memory of one kind, shared by resources whose lifetimes do not overlap.
struct PlannedHeap {
  VkDeviceSize size = 0;
  uint32_t memoryTypeBits = 0;
  MemoryKind memory = MemoryKind::device;
  bool operator==(const PlannedHeap&) const = default;
};

/// Where a resource of the graph lies, in memory and in time.
struct Placement {
  uint32_t resource = 0;
  uint32_t heap = 0;
  VkDeviceSize offset = 0, size = 0;     ///< Bytes.
  uint32_t firstStep = 0, lastStep = 0;  ///< Positions in Plan::passes, inclusive; passes.size(): exported.
  VkImageUsageFlags imageUsage = 0;
  VkBufferUsageFlags bufferUsage = 0;
  bool operator==(const Placement&) const = default;
};

/// A resource that the executor keeps across frames, and what this plan does with it.
struct RetainedResource {
  uint32_t resource = 0;
  VkImageUsageFlags imageUsage = 0;
  VkBufferUsageFlags bufferUsage = 0;
  VkImageLayout restLayout = VK_IMAGE_LAYOUT_GENERAL;  ///< Between frames; the plan starts and ends with it.
  bool operator==(const RetainedResource&) const = default;
};

struct CulledPass {
  uint32_t pass = 0;
  std::string reason;
  bool operator==(const CulledPass&) const = default;
};

/// Bytes of the graph's own resources (imported and persistent ones are not counted).
struct MemoryReport {
  VkDeviceSize peakBytes = 0;       ///< Sum of the heaps: what is allocated.
  VkDeviceSize unaliasedBytes = 0;  ///< What it would be if nothing shared memory.
  VkDeviceSize lowerBound = 0;      ///< Largest sum of sizes alive at once.
  bool operator==(const MemoryReport&) const = default;
};

struct Plan {
  std::vector<PlannedPass> passes;  ///< In execution order; culled passes are absent.
  BarrierBatch after;               ///< To the states that exports and imports ask for.
  std::vector<PlannedHeap> heaps;
  std::vector<Placement> placements;
  std::vector<RetainedResource> retained;
  std::vector<CulledPass> culled;
  MemoryReport memory;
  uint32_t barrierBatches = 0;
  bool operator==(const Plan&) const = default;
};

}  // namespace rendergraph
