// What one execution cost and where its memory lay: times, bytes, barriers, heaps, lifetimes, edges. Plain data.
//
// A capture holds one frame; capture_series.h merges several into medians and writes them as JSON, trace.h writes
// them as a timeline.
#pragma once

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "rendergraph/pass_kind.h"
#include "rendergraph/plan.h"
#include "rendergraph/usage.h"

namespace lensgraph::rendergraph {

/// One access that a pass declared.
struct CapturedUse {
  uint32_t resource = 0;  ///< Index in Capture::resources.
  Usage usage = Usage::sampled;
  Subresources range;  ///< Resolved; {0, 1, 0, 1, 0} for buffers.
  bool reads = false, writes = false;
  bool operator==(const CapturedUse&) const = default;
};

struct CapturedPass {
  std::string name;
  PassKind kind = PassKind::compute;
  uint32_t queue = 0;          ///< Index among the device's queues.
  double gpuMs = -1.0;         ///< Device time; negative when not measured.
  double gpuStartMs = -1.0;    ///< Since the frame's beginning; negative when not measured.
  double recordMs = 0.0;       ///< Host time of recording; of a host pass, of its work.
  double recordStartMs = 0.0;  ///< Since the frame's beginning.
  VkDeviceSize bytesRead = 0;  ///< Sizes of the subresources declared as read, each counted once.
  VkDeviceSize bytesWritten = 0;
  uint32_t imageBarriers = 0;  ///< That it waits for: in the batch before it, and through events.
  uint32_t bufferBarriers = 0;
  uint32_t barrierBatches = 0;     ///< Commands that hold them.
  VkExtent2D resolution = {0, 0};  ///< Of its first written image; zero without one.
  std::vector<CapturedUse> uses;   ///< In order of declaration.
};

struct CapturedResource {
  std::string name;
  std::string_view origin;  ///< "created", "imported", "persistent", "history previous", "history next".
  bool isImage = true;
  VkFormat format = VK_FORMAT_UNDEFINED;  ///< Images only, as are the four below.
  uint32_t width = 0, height = 0, layers = 1, mips = 1;
  VkDeviceSize contentBytes = 0;  ///< Of all its texels, or of the buffer; without the device's padding.
  uint32_t heap = kNone;          ///< Index in Capture::heaps; kNone: not placed by the graph.
  VkDeviceSize offset = 0;        ///< Bytes in the heap.
  VkDeviceSize size = 0;          ///< Bytes in the heap, as the device asks for.
  /// Steps (positions in Capture::passes) between which it is needed, inclusive; kNone: no kept pass uses it.
  /// lastStep is passes.size() when its content is seen after the frame.
  uint32_t firstStep = kNone, lastStep = kNone;
  bool operator==(const CapturedResource&) const = default;
};

struct CapturedHeap {
  VkDeviceSize size = 0;  ///< Bytes.
  MemoryKind memory = MemoryKind::device;
  bool operator==(const CapturedHeap&) const = default;
};

/// A pass reads what another has written, or modifies it.
struct CapturedEdge {
  uint32_t from = 0, to = 0;  ///< Steps.
  uint32_t resource = 0;      ///< Index in Capture::resources.
  bool operator==(const CapturedEdge&) const = default;
};

struct CulledName {
  std::string name, reason;
  bool operator==(const CulledName&) const = default;
};

struct Capture {
  std::string timing;  ///< "none", "inline", "isolated".
  /// Device time of the frame; negative when not measured. Never computed from the passes' times:
  /// inline    first to last timestamp of each submission, added up;
  /// isolated  the host's clock around all submissions and waits, less what recording and host passes took.
  double frameGpuMs = -1.0;
  double frameWallMs = 0.0;  ///< Host: compile, record, submit, wait.
  bool planReused = false;
  std::vector<CapturedPass> passes;         ///< In execution order.
  std::vector<CapturedResource> resources;  ///< In order of declaration.
  std::vector<CapturedHeap> heaps;
  std::vector<CulledName> culled;
  uint32_t barrierBatches = 0;  ///< Of the whole frame: before passes, through events, at ends of submissions.
  uint32_t imageBarriersAtEnd = 0, bufferBarriersAtEnd = 0;  ///< At ends of submissions.
  MemoryReport memory;
};

/// Who reads what from whom: each read leads back to the passes that wrote what it sees. By reading pass.
std::vector<CapturedEdge> edgesOf(const Capture& capture);

/// Bytes of the graph's heaps that hold something needed during a step; step passes.size() is after the last pass.
VkDeviceSize bytesAlive(const Capture& capture, uint32_t step);

}  // namespace lensgraph::rendergraph
