// Random numbers for searches whose result must be the same on every platform: splitmix64, always from one seed.
#pragma once

#include <cstdint>

namespace lensgraph::rendergraph {

class DeterministicRandom {
 public:
  /// At least 0, less than `bound`.
  uint32_t below(uint32_t bound) {
    state_ += 0x9E3779B97F4A7C15ull;
    uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
    return static_cast<uint32_t>(((z ^ (z >> 31)) >> 32) * bound >> 32);
  }

 private:
  uint64_t state_ = 0;
};

}  // namespace lensgraph::rendergraph
