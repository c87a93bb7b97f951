// compile(): declaration in, plan out. A pure function: no Vulkan objects, no clock, no global state.
#pragma once

#include <cstdint>
#include <span>

#include "rendergraph/plan.h"
#include "rendergraph/resource.h"

namespace lensgraph::rendergraph {

struct Declaration;

struct MemoryRequirements {
  VkDeviceSize size = 0;
  VkDeviceSize alignment = 1;
  uint32_t memoryTypeBits = UINT32_MAX;
  bool dedicated = false;  ///< The device wants an allocation for this resource alone; it is never aliased.
  bool operator==(const MemoryRequirements&) const = default;
};

/// One queue of a device. Every queue can transfer.
struct QueueFacts {
  uint32_t family = 0;  ///< Between queues of one family no ownership is transferred.
  bool graphics = true;
  bool compute = true;
  bool operator==(const QueueFacts&) const = default;
};

/// What compile() must know of a device. Pure: the same question always gets the same answer.
class DeviceFacts {
 public:
  virtual ~DeviceFacts() = default;
  virtual uint32_t maxImageSize() const { return 16384; }  ///< px.
  virtual uint32_t maxImageLayers() const { return 2048; }
  virtual VkDeviceSize maxBufferSize() const { return VkDeviceSize{1} << 31; }
  /// The queues that a plan may use, at least one. The first does graphics, compute and transfer; it takes what no
  /// other queue can do or nothing prefers elsewhere.
  virtual std::span<const QueueFacts> queues() const;
  virtual MemoryRequirements requirements(const ImageDesc& desc, VkImageUsageFlags usage) const = 0;
  virtual MemoryRequirements requirements(const BufferDesc& desc, VkBufferUsageFlags usage) const = 0;
};

/// A device that does not exist: linear sizes, 64 KiB alignment, one memory type. For tests and offline plans.
class NominalDevice : public DeviceFacts {
 public:
  MemoryRequirements requirements(const ImageDesc& desc, VkImageUsageFlags usage) const override;
  MemoryRequirements requirements(const BufferDesc& desc, VkBufferUsageFlags usage) const override;
};

enum class Order : uint8_t {
  declared,     ///< As the passes were declared.
  leastMemory,  ///< Fewest bytes alive at once that are found, never more than declared; up to some milliseconds.
  mostOverlap,  ///< Dependent passes far apart, so that barriers wait for nothing.
  /// In as few groups without a barrier inside as fit in CompileOptions::memoryBudget. Memory changes hands between
  /// groups only; BarrierTiming::fewestBatches then needs one batch a group. Up to some milliseconds.
  fewestBatches,
};

/// Where a barrier stands between the two uses that it separates.
enum class BarrierTiming : uint8_t {
  beforeUse,      ///< As late as possible, so that it waits for as little as possible.
  fewestBatches,  ///< Together with others wherever that is allowed: the smallest number of batches for the order.
};

/// How resources that are not alive at the same time share memory.
enum class Aliasing : uint8_t {
  none,  ///< Every resource has its own memory (to measure what sharing saves).
  fast,  ///< Below 0.1 µs a resource, for graphs whose structure changes from frame to frame.
  best,  ///< Nearest to the lower bound; up to some milliseconds, once per structure, since plans are cached.
};

struct CompileOptions {
  Order order = Order::declared;
  /// Order::fewestBatches: bytes of the graph's own resources that may be alive at once, as a multiple of what the
  /// declared order needs, at least 0. Small: fewest bytes, a batch before nearly every pass; infinity: no more
  /// batches than the longest chain of passes asks for. 1 costs no memory and is usually near that.
  float memoryBudget = 1.0f;
  BarrierTiming barriers = BarrierTiming::beforeUse;
  /// Barriers whose sides have at least this many steps between them are split into an event that is set and one
  /// that is waited for, so that what lies between fills the wait; 0: none is split.
  uint32_t splitDistance = 0;
  /// Adjacent raster passes with the same attachments share one rendering.
  bool mergeRasterPasses = true;
  /// Passes run on the queues that they prefer; off: all on the first one.
  bool useQueues = true;
  /// The device may begin a frame before it has finished the one before: first uses wait for the last uses of the
  /// same memory in the frame before. Needed when several frames are in flight; off, the host waits in between.
  bool overlappingFrames = false;
  Aliasing aliasing = Aliasing::best;
  bool operator==(const CompileOptions&) const = default;
};

/// Throws GraphError with every problem found. The declaration is not changed.
Plan compile(const Declaration& declaration, const CompileOptions& options, const DeviceFacts& device);

/// Hash over every field of the declaration that the plan depends on (not names, recordings, clear values or
/// the imported Vulkan objects).
uint64_t structuralHash(const Declaration& declaration, const CompileOptions& options);

}  // namespace lensgraph::rendergraph
