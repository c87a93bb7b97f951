// What a ray-traced picture has gathered so far, and its file: so that a rendering that was interrupted goes on.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "engine/image/image.h"

namespace lensgraph::engine {

/// One pixel. Sums are of doubles, so that the order of rounds is all that decides the bits.
struct PixelSum {
  double red = 0.0, green = 0.0, blue = 0.0;  ///< Of weight times radiance.
  double weight = 0.0;                        ///< Of the samples.
  uint32_t lensPoints = 0;                    ///< Of the pixel's sequence, taken so far: those that were rejected too.
  uint32_t replaced = 0;                      ///< Samples that were not finite and count as black.
};

struct PictureState {
  uint32_t width = 0, height = 0;  ///< px
  uint32_t samplesDone = 0;        ///< Of each pixel.
  std::vector<PixelSum> pixels;    ///< Top row first.

  /// Linear RGBA with alpha 1. Precondition: samplesDone > 0.
  FloatImage picture() const;
};

/// What must be the same for a state to be continued: names for people, in an order, with a value or a hash of many.
using StateIdentity = std::vector<std::pair<std::string, std::string>>;

/// Writes the state whole or not at all. Throws Error as OutputFile does.
void saveState(const std::filesystem::path& file, const StateIdentity& identity, const PictureState& state);

/// The state in the file; a new one when there is no such file. Throws Error (bad input) when the file is no state, is
/// damaged, or is that of another identity: the message names what differs.
PictureState loadState(const std::filesystem::path& file, const StateIdentity& identity, uint32_t width,
                       uint32_t height);

/// FNV-1a, 64 bits: tells different inputs apart, and is no protection against those who forge them.
class StateHash {
 public:
  void add(const void* bytes, std::size_t size);
  template <class T>
  void add(const std::vector<T>& items) {
    const uint64_t count = items.size();
    add(&count, sizeof count);
    add(items.data(), items.size() * sizeof(T));
  }
  std::string hex() const;

 private:
  uint64_t value_ = 0xcbf29ce484222325u;
};

}  // namespace lensgraph::engine
