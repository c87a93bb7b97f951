// The result of compiling a declaration: plain data, equal for equal input, printable, testable without a device.
//
// Indices refer to the declaration (resources, passes) or to the plan's own arrays. Nothing here is a Vulkan object.
// What belongs to one pass lies in runs of the plan's arrays, so that a plan is a handful of allocations.
//
// How a plan is carried out. The submissions are given to their queues in the order of the list. Each one waits for
// the submissions it names, at the stages it names; then it executes its steps one after the other, and its `atEnd`
// barriers last. One step is:
//   1. the events that it waits for (vkCmdWaitEvents2), one after the other;
//   2. the batch `before` (one vkCmdPipelineBarrier2);
//   3. the pass itself; a raster pass begins its rendering unless it continues that of the step before, and ends it
//      unless the next step continues it;
//   4. the events to set (vkCmdSetEvent2).
// A host pass is the last step of its submission: after 2. the submission is given to the queue, the host waits for
// it, and runs the pass before it gives the next submission to any queue.
#pragma once

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "rendergraph/handle.h"
#include "rendergraph/resource.h"

namespace lensgraph::rendergraph {

/// A use of a resource that a barrier waits for, or that waits for it.
struct AccessPoint {
  uint32_t pass = kNone;  ///< kNone: the host before or after the graph, or the frame before this one.
  VkPipelineStageFlags2 stages = 0;
  VkAccessFlags2 access = 0;
  bool operator==(const AccessPoint&) const = default;
};

/// Why a barrier is there.
enum class BarrierReason : uint8_t {
  readAfterWrite,
  writeAfterRead,
  writeAfterWrite,
  layout,   ///< Only the layout changes.
  alias,    ///< Another resource had the memory before, in this frame or the one before it.
  release,  ///< First half of a transfer of ownership to another queue family; no later use on this queue.
  acquire,  ///< Second half of it, with the same layouts.
};

/// `to` covers every use that the barrier serves: a run of reads by several passes waits once, before the first.
struct ImageBarrier {
  uint32_t resource = 0;
  Subresources range = {};  ///< Resolved: counts are numbers, aspects are set.
  AccessPoint from = {}, to = {};
  VkImageLayout oldLayout = VK_IMAGE_LAYOUT_UNDEFINED;
  VkImageLayout newLayout = VK_IMAGE_LAYOUT_UNDEFINED;
  uint32_t fromQueue = kNone;  ///< Release and acquire: index among the device's queues. kNone: same owner as before.
  uint32_t toQueue = kNone;
  BarrierReason reason = BarrierReason::layout;
  bool operator==(const ImageBarrier&) const = default;
};

struct BufferBarrier {
  uint32_t resource = 0;
  AccessPoint from = {}, to = {};
  uint32_t fromQueue = kNone, toQueue = kNone;
  BarrierReason reason = BarrierReason::readAfterWrite;
  bool operator==(const BufferBarrier&) const = default;
};

/// Elements first … first + count - 1 of one of the plan's arrays.
struct Run {
  uint32_t first = 0, count = 0;
  bool operator==(const Run&) const = default;
};

/// Barriers given to Vulkan in one command.
struct BarrierBatch {
  Run images, buffers;  ///< Of Plan::imageBarriers and Plan::bufferBarriers.
  bool empty() const { return images.count == 0 && buffers.count == 0; }
  bool operator==(const BarrierBatch&) const = default;
};

/// A split barrier: an event that is set where the first side is done, and waited for where the second begins. Both
/// lie on one queue, in this order.
struct PlannedEvent {
  uint32_t setAfter = 0, waitBefore = 0;  ///< Steps.
  BarrierBatch barriers;
  bool operator==(const PlannedEvent&) const = default;
};

struct PlannedAttachment {
  uint32_t resource = 0;
  Subresources range;
  VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
  VkAttachmentLoadOp load = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
  VkAttachmentStoreOp store = VK_ATTACHMENT_STORE_OP_STORE;
  uint32_t resolve = kNone;  ///< Index in Plan::attachments of the image that receives the mean of the samples.
  bool operator==(const PlannedAttachment&) const = default;
};

struct PlannedPass {
  uint32_t pass = 0;   ///< Index in the declaration.
  uint32_t queue = 0;  ///< Index among the device's queues.
  BarrierBatch before;
  Run waits;  ///< Of Plan::events.
  Run sets;   ///< Of Plan::eventSets.
  // Raster passes:
  bool continuesRendering = false;  ///< Draws in the rendering that the step before began: same attachments.
  Run colors;                       ///< Of Plan::attachments, in order of declaration.
  Run depth;                        ///< Zero or one.
  VkExtent2D renderArea = {0, 0};
  uint32_t renderLayers = 1;
  bool operator==(const PlannedPass& other) const {
    return pass == other.pass && queue == other.queue && before == other.before && waits == other.waits &&
           sets == other.sets && continuesRendering == other.continuesRendering && colors == other.colors &&
           depth == other.depth && renderArea.width == other.renderArea.width &&
           renderArea.height == other.renderArea.height && renderLayers == other.renderLayers;
  }
};

/// Waits for an earlier submission on another queue (a timeline semaphore).
struct SubmissionWait {
  uint32_t submission = 0;           ///< Index in Plan::submissions, smaller than that of the waiting one.
  VkPipelineStageFlags2 stages = 0;  ///< Of the waiting submission and all later ones on its queue.
  bool operator==(const SubmissionWait&) const = default;
};

/// Steps that one queue executes without waiting for another in between: one vkQueueSubmit2. A plan on one queue has
/// a single one, or one more for each host pass. A plan on several begins with one without steps on
/// queue 0, for which others wait where they need what the host or the frame before did, and ends with one on queue 0
/// that waits for all.
struct PlannedSubmission {
  uint32_t queue = 0;
  Run steps;           ///< Of Plan::passes; may be empty.
  Run waits;           ///< Of Plan::submissionWaits.
  BarrierBatch atEnd;  ///< For those that wait for it: changes of layout and releases. In the last submission: the
                       ///< states that exports and imports ask for.
  bool operator==(const PlannedSubmission&) const = default;
};

/// A block of memory of one kind, shared by resources whose lifetimes do not overlap.
struct PlannedHeap {
  VkDeviceSize size = 0;
  uint32_t memoryTypeBits = 0;
  MemoryKind memory = MemoryKind::device;
  bool dedicated = false;  ///< The device wants this memory to hold one resource alone.
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
  bool concurrent = false;  ///< Several queue families read it at once: VK_SHARING_MODE_CONCURRENT.
  bool operator==(const Placement&) const = default;
};

/// A resource that the executor keeps across frames, and what this plan does with it.
struct PersistentResource {
  uint32_t resource = 0;
  VkImageUsageFlags imageUsage = 0;
  VkBufferUsageFlags bufferUsage = 0;
  VkImageLayout restLayout = VK_IMAGE_LAYOUT_GENERAL;  ///< Between frames; the plan starts and ends with it.
  bool concurrent = false;                             ///< As in Placement.
  bool operator==(const PersistentResource&) const = default;
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
  std::vector<PlannedSubmission> submissions;
  std::vector<PlannedHeap> heaps;
  std::vector<Placement> placements;
  std::vector<PersistentResource> persistent;
  std::vector<CulledPass> culled;
  MemoryReport memory;
  uint32_t barrierBatches = 0;  ///< Commands: batches before passes, at ends of submissions, and events.

  // What the runs refer to:
  std::vector<ImageBarrier> imageBarriers;
  std::vector<BufferBarrier> bufferBarriers;
  std::vector<PlannedAttachment> attachments;
  std::vector<PlannedEvent> events;  ///< By the step that waits.
  std::vector<uint32_t> eventSets;   ///< Indices of events, by the step that sets.
  std::vector<SubmissionWait> submissionWaits;

  bool operator==(const Plan&) const = default;

  std::span<const ImageBarrier> imagesOf(const BarrierBatch& batch) const { return runOf(imageBarriers, batch.images); }
  std::span<const BufferBarrier> buffersOf(const BarrierBatch& batch) const {
    return runOf(bufferBarriers, batch.buffers);
  }
  std::span<const PlannedAttachment> colorsOf(const PlannedPass& pass) const { return runOf(attachments, pass.colors); }
  std::span<const PlannedAttachment> depthOf(const PlannedPass& pass) const { return runOf(attachments, pass.depth); }
  std::span<const PlannedEvent> waitsOf(const PlannedPass& pass) const { return runOf(events, pass.waits); }
  std::span<const uint32_t> setsOf(const PlannedPass& pass) const { return runOf(eventSets, pass.sets); }
  std::span<const PlannedPass> stepsOf(const PlannedSubmission& submission) const {
    return runOf(passes, submission.steps);
  }
  std::span<const SubmissionWait> waitsOf(const PlannedSubmission& submission) const {
    return runOf(submissionWaits, submission.waits);
  }

 private:
  template <class T>
  static std::span<const T> runOf(const std::vector<T>& all, const Run& run) {
    return std::span<const T>(all).subspan(run.first, run.count);
  }
};

}  // namespace lensgraph::rendergraph
