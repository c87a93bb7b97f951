// Image files: EXR, PNG and Radiance HDR. The only user of OpenImageIO and libpng.
//
// In memory colour is linear and premultiplied (see image.h); PNG files are sRGB-encoded and not
// premultiplied, and are converted both ways here. EXR and HDR hold linear values and are never
// colour-converted, whatever their metadata say. Does not do: tone mapping (only exposure and clamp, for
// PNG), mips, tiles, animated files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "engine/image/image.h"

namespace lensgraph::engine {

/// Sample type of an EXR file. Half keeps 11 bits and ends at 65504; larger finite values become infinite in
/// it.
enum class ExrSampleType { half16, float32 };

struct ImageWriteOptions {
  ExrSampleType exrSampleType = ExrSampleType::float32;  ///< EXR only.
  double exposureEv = 0.0;  ///< PNG only: colour is multiplied by 2^exposureEv before it is clamped and encoded.
};

/// Which channels to read, where names alone leave it open. PNG and HDR have no layers.
struct ChannelChoice {
  /// readImage(): a layer, such as "ViewLayer.Combined"; readDepth(): a channel, such as "ViewLayer.Depth.Z". In either
  /// case of letters. Empty (default): found by the rules below.
  std::string name;
  std::string option;  ///< Where a user says it, such as "--depth-channel", for the remedies of errors. Empty: nowhere.
};

/// What was read of a file. "ViewLayer.Depth.Z" is the channel Z of the layer "ViewLayer.Depth"; in a file of several
/// parts, a part's name is the layer of its channels that name none.
struct ChannelsRead {
  std::string part;                   ///< Empty in files of one part.
  std::string layer;                  ///< Empty for channels of no layer.
  std::vector<std::string> channels;  ///< As in the file.
};

struct PictureRead {
  FloatImage image;
  ChannelsRead from;
  uint32_t largestInteger = 0;  ///< 255 or 65535 for PNG, whose samples are integers; 0 for floats.
};

/// Reads a colour picture (.exr, .png, .hdr): 3 channels (RGB), 4 (RGBA, when there is alpha) or 1 (grey: a file with a
/// single channel, or with Y). Grey with alpha becomes RGBA.
/// Of an EXR, all parts are searched for layers with R, G and B (Red, Green, Blue); only the channels that are returned
/// are read. The layer without a name is taken, else the only one called Combined, beauty, rgba, rgb or color (also below
/// a view layer: ViewLayer.Combined), else the only one there is. Pixels outside the data window are 0.
/// Files of more than 2^28 pixels or 65536 px a side are refused, and what a file claims is checked against its size
/// before memory is taken for it. Metadata are not read.
/// Throws Error: missing, empty, truncated, too large or unsupported file (deep data, luminance and chroma, XYZ); a pipe
/// or device; no colour, or several layers of it, with a list of them.
PictureRead readImage(const std::filesystem::path& path, const ChannelChoice& layer);
FloatImage readImage(const std::filesystem::path& path);

/// Reads a depth picture as one channel, values as they stand in the file: what they mean is not known here.
/// EXR: the channel called Z or depth (ZDepth, Z-Depth, Z_Depth), or V or the only one of a layer of that name, in all
/// parts; or the only channel of the file. Never one called like colour (R, G, B, A, Y, X …), one of a layer with X
/// beside it, or one below a layer called normal, position, UV, vector, motion, mist or alike, unless it is asked for.
/// Pixels outside the data window are infinitely far. PNG: 8 or 16 bits, grey or three equal channels, integers from 0 to
/// PictureRead::largestInteger; never decoded.
/// Throws Error: as readImage(); no such channel, or several, with a list of them; a PNG in colour, with a palette or of
/// fewer bits.
PictureRead readDepth(const std::filesystem::path& path, const ChannelChoice& channel);
FloatImage readDepth(const std::filesystem::path& path);

/// The same for a file in memory. `name` has the extension that tells the format, and names it in errors.
PictureRead readImage(std::span<const std::byte> bytes, const std::filesystem::path& name, const ChannelChoice& layer);
PictureRead readDepth(std::span<const std::byte> bytes, const std::filesystem::path& name,
                      const ChannelChoice& channel);

/// Writes a picture; the extension chooses the format: .exr, .png (8 bit) or .hdr, in any case of letters.
/// 1 channel: EXR channel Z, grey PNG, HDR with three equal channels; 3: RGB; 4: RGBA (HDR has no alpha and
/// drops it). PNG: NaN becomes 0. The file appears whole or not at all, as engine/files/output_file.h says.
/// Throws Error: unknown extension, destination that cannot be written, picture without pixels or with 2 or 5+
/// channels; of kind failed where the disk is full.
void writeImage(const std::filesystem::path& path, const FloatImage& image, const ImageWriteOptions& options = {});

/// The bytes of the PNG file that writeImage() would write. `exposureEv`: stops, as in ImageWriteOptions.
/// Throws Error: picture without pixels or with 2 or 5+ channels.
std::vector<unsigned char> encodePng(const FloatImage& image, double exposureEv = 0.0);

}  // namespace lensgraph::engine
