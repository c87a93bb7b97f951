// Names of picture formats, and the refusal of files: see image_format.h.
#include "engine/image/image_format.h"

#include <algorithm>
#include <cctype>

namespace lensgraph::engine {

ImageFormat imageFormatOf(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  if (extension == ".exr") return ImageFormat::exr;
  if (extension == ".png") return ImageFormat::png;
  if (extension == ".hdr") return ImageFormat::hdr;
  failImage(
      path,
      extension.empty() ? "has no extension to tell the image format" : "unknown image format '" + extension + "'",
      "use .exr, .png or .hdr");
}

void failImage(const std::filesystem::path& path, const std::string& reason, const std::string& remedy,
               ErrorKind kind) {
  throw Error(ErrorParts{.file = path.string(), .field = {}, .reason = reason, .remedy = remedy}, kind);
}

}  // namespace lensgraph::engine
