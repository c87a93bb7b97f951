// Files that the program writes: checked before the work so that none is lost, and there whole or not at all.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "engine/image/image.h"

namespace lensgraph::cli {

/// Throws engine::Error unless the file could be written, as engine::requireWritable() says. `extensions`: those
/// allowed, lower case with the dot; empty allows any. Leaves nothing behind.
void checkOutput(const std::filesystem::path& file, std::string_view option,
                 std::span<const std::string_view> extensions = {});

/// Makes the folder that `option` names, and those above it, where it is not there yet. Throws engine::Error unless it is a
/// folder then and takes a file called `file`.
void makeOutputFolder(const std::filesystem::path& folder, const std::string& option, const std::string& file);

struct OutputFile {
  std::filesystem::path file;
  std::string option;  ///< That names it.
};

/// Throws engine::Error (bad input) when two of them are the same file. Empty paths are no file.
void requireDistinct(std::span<const OutputFile> files);

/// Extensions of pictures and of depth, as engine/image_io writes them.
inline constexpr std::string_view kPictureExtensions[] = {".exr", ".png", ".hdr"};
inline constexpr std::string_view kDepthExtensions[] = {".exr"};
/// Of images inside the graph: exact values (EXR), or a picture of them (PNG).
inline constexpr std::string_view kDumpExtensions[] = {".exr", ".png"};

/// Warns when an exposure is asked for although the format keeps scene light.
void warnUnusedExposure(const std::filesystem::path& output);

/// Writes what --output names, and warns when most of it is beyond what the format can show.
void writePicture(const std::filesystem::path& output, const engine::FloatImage& color,
                  const std::optional<double>& exposureEv);

/// As engine::writeFile(). "-" is stdout.
void writeTextFile(const std::filesystem::path& file, std::string_view text);

}  // namespace lensgraph::cli
