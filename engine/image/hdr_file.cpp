// Reads Radiance HDR files: see picture_file.h. The header is checked here; OpenImageIO reads the pixels.
#include <algorithm>
#include <charconv>
#include <string>
#include <string_view>

#include "engine/image/image_format.h"
#include "engine/image/oiio_input.h"
#include "engine/image/picture_file.h"

namespace lensgraph::engine {
namespace {

namespace fs = std::filesystem;

struct Header {
  int64_t width = 0, height = 0;
  size_t pixels = 0;  ///< Where they begin.
};

/// Takes the next line, without its end.
std::string_view takeLine(std::string_view& text) {
  const size_t end = text.find('\n');
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  return line;
}

/// "-Y 480 +X 640", in any of the eight orientations.
bool parseResolution(std::string_view line, Header& header) {
  for (int i = 0; i < 2; ++i) {
    if (line.size() < 4 || (line[0] != '-' && line[0] != '+') || (line[1] != 'X' && line[1] != 'Y')) return false;
    int64_t& side = line[1] == 'X' ? header.width : header.height;
    line.remove_prefix(2);
    line.remove_prefix(std::min(line.find_first_not_of(' '), line.size()));
    const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), side);
    if (error != std::errc{}) return false;
    line.remove_prefix(static_cast<size_t>(end - line.data()));
    line.remove_prefix(std::min(line.find_first_not_of(' '), line.size()));
  }
  return header.width != 0 && header.height != 0;
}

Header readHeader(const fs::path& path, std::span<const std::byte> bytes) {
  // A header is short; a file without one is not searched to its end.
  const std::string_view all(reinterpret_cast<const char*>(bytes.data()), std::min<size_t>(bytes.size(), 1 << 16));
  if (!all.starts_with("#?")) failImage(path, "is not a Radiance HDR file");
  std::string_view rest = all;
  while (!rest.empty() && !takeLine(rest).empty()) {
  }
  Header header;
  const std::string_view resolution = takeLine(rest);
  if (!parseResolution(resolution, header)) failImage(path, "is damaged or truncated: its header has no picture size");
  header.pixels = static_cast<size_t>(resolution.data() + resolution.size() - all.data());
  return header;
}

/// The fewest bytes that the picture can take: a line of 8 to 32767 px may be four channels of runs of up to 127 equal
/// values, two bytes each; others are four bytes a pixel.
int64_t leastBytes(const Header& header) {
  const bool hasRuns = header.width >= 8 && header.width <= 32767;
  return header.height * (hasRuns ? 4 + 4 * 2 * ((header.width + 126) / 127) : 4 * header.width);
}

class HdrFile : public PictureFile {
 public:
  HdrFile(const fs::path& path, std::vector<std::byte> bytes) : path_(path), bytes_(std::move(bytes)) {
    const Header header = readHeader(path_, bytes_);
    requireReadableSize(path_, header.width, header.height);
    if (leastBytes(header) > static_cast<int64_t>(bytes_.size() - header.pixels)) {
      failImage(path_, "is damaged or truncated: " + std::to_string(bytes_.size()) + " bytes cannot hold " +
                           std::to_string(header.width) + "x" + std::to_string(header.height) + " pixels");
    }
    parts_ = {{.name = {}, .channels = {"R", "G", "B"}, .isDeep = false}};
  }

  FloatImage read(size_t, std::span<const size_t> channels, float) override {
    OiioInput input(path_, "hdr", bytes_);
    const OIIO::ImageSpec& spec = input.select(0);
    requireReadableSize(path_, spec.width, spec.height);
    if (spec.nchannels != 3) failImage(path_, "is damaged or truncated");
    const std::vector<float> samples = input.read(0, 3);
    FloatImage image(static_cast<uint32_t>(spec.width), static_cast<uint32_t>(spec.height),
                     static_cast<uint32_t>(channels.size()));
    for (size_t i = 0; i < image.pixelCount(); ++i) {
      for (size_t c = 0; c < channels.size(); ++c)
        image.samples[i * channels.size() + c] = samples[3 * i + channels[c]];
    }
    return image;
  }

 private:
  fs::path path_;
  std::vector<std::byte> bytes_;
};

}  // namespace

std::unique_ptr<PictureFile> openHdr(const fs::path& path, std::vector<std::byte> bytes) {
  return std::make_unique<HdrFile>(path, std::move(bytes));
}

}  // namespace lensgraph::engine
