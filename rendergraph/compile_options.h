// What a host chooses about the plan: order of passes, use of memory, barriers, queues.
#pragma once

#include <cstdint>

namespace lensgraph::rendergraph {

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

}  // namespace lensgraph::rendergraph
