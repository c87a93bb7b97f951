// Who had a resource's memory before it. Pure.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rendergraph/plan.h"

namespace lensgraph::rendergraph {

/// A resource that occupied the same memory earlier; its last uses must finish first.
struct MemoryPredecessor {
  uint32_t resource = 0;
  bool frameBefore = false;  ///< It had the memory at the end of the frame before; it may be the resource itself.
  bool operator==(const MemoryPredecessor&) const = default;
};

class MemoryPredecessors {
 public:
  MemoryPredecessors() = default;
  /// `fullyUsed`: by resource, whether every part of it is used, so that waiting for it is waiting for everybody
  /// before it as well. `overlappingFrames`: as in CompileOptions.
  MemoryPredecessors(std::span<const Placement> placements, std::size_t resources, std::span<const uint8_t> fullyUsed,
                     bool overlappingFrames);
  std::span<const MemoryPredecessor> before(uint32_t resource) const {
    return {all_.data() + starts_[resource], all_.data() + starts_[resource] + counts_[resource]};
  }

 private:
  std::vector<uint32_t> starts_, counts_;  // By resource.
  std::vector<MemoryPredecessor> all_;
};

}  // namespace lensgraph::rendergraph
