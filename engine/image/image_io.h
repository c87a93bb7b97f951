// Image files: EXR, PNG and Radiance HDR. The only user of OpenImageIO.
//
// In memory colour is linear and premultiplied (see image.h); PNG files are sRGB-encoded and not
// premultiplied, and are converted both ways here. EXR and HDR hold linear values and are never
// colour-converted, whatever their metadata say. Does not do: tone mapping (only exposure and clamp, for
// PNG), mips, tiles, animated files.
#pragma once

#include <filesystem>

#include "engine/image/image.h"

namespace lensgraph::engine {

/// Sample type of an EXR file. Half keeps 11 bits and ends at 65504; larger finite values become infinite in
/// it.
enum class ExrSampleType { half16, float32 };

struct ImageWriteOptions {
  ExrSampleType exrSampleType = ExrSampleType::float32;  ///< EXR only.
  double exposureEv = 0.0;  ///< PNG only: colour is multiplied by 2^exposureEv before it is clamped and encoded.
};

/// Reads a colour picture (.exr, .png, .hdr).
/// Gives 3 channels (RGB), 4 (RGBA, when the file has alpha) or 1 (a file with a single channel).
/// Grey PNGs with alpha become RGBA. Of an EXR with more channels, those named R, G, B and A are taken.
/// Throws Error: missing, empty, truncated or unsupported file, or one without a colour channel.
FloatImage readImage(const std::filesystem::path& path);

/// Reads a depth picture as one channel: the EXR channel Z, else depth, Y, V or the only channel; else R.
/// Values are returned as they stand in the file (an EXR or HDR is expected; PNGs are refused: they cannot
/// hold depth).
FloatImage readDepth(const std::filesystem::path& path);

/// Writes a picture; the extension chooses the format: .exr, .png (8 bit) or .hdr, in any case of letters.
/// 1 channel: EXR channel Z, grey PNG, HDR with three equal channels; 3: RGB; 4: RGBA (HDR has no alpha and
/// drops it). PNG: NaN becomes 0. The file appears whole or not at all, as engine/files/output_file.h says.
/// Throws Error: unknown extension, destination that cannot be written, picture without pixels or with 2 or 5+
/// channels; of kind failed where the disk is full.
void writeImage(const std::filesystem::path& path, const FloatImage& image, const ImageWriteOptions& options = {});

}  // namespace lensgraph::engine
