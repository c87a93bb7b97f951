// A picture file that is open: its parts and channels, and the reading of some of them. Private to engine/image.
//
// Everything that a file claims is checked against its size and the limits below before memory is taken for it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/image/image.h"

namespace lensgraph::engine {

/// Larger pictures are refused. 2^28 pixels are 16384 x 16384, the largest picture of today's devices, and 4 GB as RGBA.
inline constexpr int64_t kMaxSide = 65536;
inline constexpr int64_t kMaxPixels = int64_t{1} << 28;
/// Of all parts of a file together.
inline constexpr size_t kMaxChannels = 1024;

/// Throws Error that names the file unless 1 <= side <= kMaxSide and there are at most kMaxPixels.
void requireReadableSize(const std::filesystem::path& path, int64_t width, int64_t height);

/// One picture of a file; EXR files may hold several.
struct PicturePart {
  std::string name;                   ///< Empty where the format has no names.
  std::vector<std::string> channels;  ///< Names as in the file: "R", "ViewLayer.Depth.Z". PNG: Y, YA, RGB or RGBA.
  bool isDeep = false;                ///< Several samples a pixel; not read.
};

class PictureFile {
 public:
  virtual ~PictureFile() = default;

  const std::vector<PicturePart>& parts() const { return parts_; }
  /// The largest value of a picture of integers; 0 for one of floats.
  uint32_t largestInteger() const { return largestInteger_; }
  /// Throws Error unless integers are given as they stand in the file, of 8 or 16 bits: neither stretched nor from a
  /// palette.
  virtual void requireWholeSamples() const {}
  /// Whether integers are sRGB-encoded colour.
  bool isEncoded() const { return isEncoded_; }

  /// Those channels of a part, interleaved in that order, values as they stand in the file. The picture is the display
  /// window, with `outside` where the file has no pixels. Throws Error: damaged file.
  virtual FloatImage read(size_t part, std::span<const size_t> channels, float outside) = 0;

 protected:
  std::vector<PicturePart> parts_;
  uint32_t largestInteger_ = 0;
  bool isEncoded_ = false;
};

/// Open a file's bytes, which the result keeps. `path` is for messages. Throw Error: not that format, damaged, too
/// large, of a kind that is not read.
std::unique_ptr<PictureFile> openExr(const std::filesystem::path& path, std::vector<std::byte> bytes);
std::unique_ptr<PictureFile> openHdr(const std::filesystem::path& path, std::vector<std::byte> bytes);
std::unique_ptr<PictureFile> openPng(const std::filesystem::path& path, std::vector<std::byte> bytes);

}  // namespace lensgraph::engine
