// How much memory the geometry of a file may take: in proportion to what the file holds. Private to engine/gltf.
//
// A few bytes of JSON can ask for gigabytes: primitives that repeat an accessor, accessors without buffer view (all
// zeros), instances of meshes with many primitives. So each byte that the file holds gives kFreeBytes of memory once, to
// the part of the scene (a primitive) that reads it first; what a part takes beyond is repetition, and that has a limit.
#pragma once

#include <cstdint>

namespace lensgraph::engine::gltf {

class MemoryLimit {
 public:
  /// Memory for one byte of the file, the first time that it is read. The most that plain geometry needs is 21
  /// (8-bit positions, strips, no normals).
  static constexpr uint64_t kFreeBytes = 24;
  /// Memory for what is repeated: this, and kRepeatedBytes for each byte of the file.
  static constexpr uint64_t kBase = 12'000'000;
  static constexpr uint64_t kRepeatedBytes = 6;

  /// A new part of the scene begins: what the last one was given and did not take is gone.
  void startPart() { unused_ = 0; }

  /// Takes memory for `loaded` bytes that come from `stored` bytes of a file (0: from nothing). `held` is how many
  /// bytes the file holds as far as it has been read, with streams decoded. False: that is more than the limit.
  bool take(uint64_t loaded, uint64_t stored, uint64_t held);

  /// The memory that repetition may take, for messages.
  static uint64_t repeatedLimit(uint64_t held) { return kBase + kRepeatedBytes * held; }

 private:
  uint64_t read_ = 0;      ///< Bytes of the file that have given their memory.
  uint64_t unused_ = 0;    ///< Of what they gave to the current part.
  uint64_t repeated_ = 0;  ///< Memory beyond.
};

}  // namespace lensgraph::engine::gltf
