// Checking and writing of files: see output.h.
#include "samples/lensgraph/output.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cctype>
#include <iostream>
#include <vector>

#include "engine/error.h"
#include "engine/files/output_file.h"
#include "engine/image/image_io.h"
#include "samples/host/warnings.h"

namespace lensgraph::cli {
namespace {

using std::filesystem::path;

std::string lowerExtension(const path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

void checkExtension(const path& file, std::string_view option, std::span<const std::string_view> extensions) {
  const std::string extension = lowerExtension(file);
  if (extensions.empty() || std::find(extensions.begin(), extensions.end(), extension) != extensions.end()) return;
  std::string known;
  for (const auto each : extensions) known += (known.empty() ? "" : ", ") + std::string(each);
  throw engine::Error({.file = file.string(),
                       .field = std::string(option),
                       .reason = extension.empty() ? "has no extension" : "unknown format " + extension,
                       .remedy = "formats are " + known});
}

}  // namespace

void checkOutput(const path& file, std::string_view option, std::span<const std::string_view> extensions) {
  if (!file.empty()) checkExtension(file, option, extensions);
  engine::requireWritable(file, std::string(option));
}

void makeOutputFolder(const path& folder, const std::string& option, const std::string& file) {
  std::error_code code;
  std::filesystem::create_directories(folder, code);
  if (!std::filesystem::is_directory(folder)) {
    throw engine::Error({.file = folder.string(),
                         .field = option,
                         .reason = "cannot be made: " + (code ? code.message() : "a file is in its place"),
                         .remedy = "choose another folder"});
  }
  engine::requireWritable(folder / file, option);
}

void requireDistinct(std::span<const OutputFile> files) {
  std::vector<path> places;
  for (const OutputFile& file : files) {
    places.push_back(engine::writtenPath(file.file));
    // What is written straight may be given twice, as /dev/null is.
    std::error_code code;
    const auto status = std::filesystem::status(file.file, code);
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) places.back().clear();
  }
  for (std::size_t i = 0; i < files.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (places[i].empty() || places[i] != places[j]) continue;
      throw engine::Error({.file = files[i].file.string(),
                           .field = files[j].option,
                           .reason = "is the same file as " + files[i].option,
                           .remedy = "choose another"});
    }
  }
}

void warnUnusedExposure(const path& output) {
  if (lowerExtension(output) != ".png") {
    spdlog::warn("{}: --exposure changes only .png; this file keeps the scene's light", output.string());
  }
}

void writePicture(const path& output, const engine::FloatImage& color, const std::optional<double>& exposureEv) {
  const double exposure = exposureEv.value_or(0.0);
  engine::writeImage(output, color, {.exposureEv = exposure});
  if (lowerExtension(output) != ".png") return;
  if (const auto warning = host::clippedPictureWarning(color, exposure)) {
    spdlog::warn("{}: {}", output.string(), *warning);
  }
}

void writeTextFile(const path& file, std::string_view text) {
  if (file == "-") {
    std::cout << text;
    return;
  }
  engine::writeFile(file, text);
}

}  // namespace lensgraph::cli
