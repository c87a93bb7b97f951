// Counts memory against what the file holds.
#include "engine/gltf/read/memory_limit.h"

#include <algorithm>

namespace lensgraph::engine::gltf {

bool MemoryLimit::take(uint64_t loaded, uint64_t stored, uint64_t held) {
  const uint64_t fresh = std::min(stored, held - std::min(held, read_));
  read_ += fresh;
  unused_ += kFreeBytes * fresh;
  const uint64_t free = std::min(loaded, unused_), repeated = loaded - free;
  unused_ -= free;
  const uint64_t limit = repeatedLimit(held);
  if (repeated > limit - std::min(limit, repeated_)) return false;
  repeated_ += repeated;
  return true;
}

}  // namespace lensgraph::engine::gltf
