// Reads picture files with OpenImageIO. See image_io.h for the conventions.
//
// OpenImageIO is asked for raw values: alpha is never multiplied for us (oiio:UnassociatedAlpha) and no colour space is
// converted; sRGB and premultiplication are done here, in linear light, where OpenImageIO would do them encoded.
#include <OpenImageIO/imageio.h>

#include <cstdint>
#include <fstream>
#include <memory>
#include <new>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "engine/error.h"
#include "engine/image/image_format.h"
#include "engine/image/image_io.h"
#include "engine/image/metrics.h"

namespace lensgraph::engine {
namespace {

namespace fs = std::filesystem;

// More pixels than this are taken for a damaged header: 16384 x 16384 is the largest picture of today's
// devices.
constexpr int64_t kMaxPixels = int64_t{1} << 28;
constexpr int kMaxChannels = 1024;

struct Input {
  std::unique_ptr<OIIO::ImageInput> file;
  OIIO::ImageSpec spec;  ///< A copy: the file's own may change while reading.
  ImageFormat format;
};

void requireReadableFile(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) failImage(path, "no such file");
  if (fs::is_directory(status)) failImage(path, "is a folder, not an image");
  const auto bytes = fs::file_size(path, error);
  if (!error && bytes == 0) failImage(path, "is empty (0 bytes)");
}

// Walks the chunks of a PNG to its end. libpng would find a truncated file too, but reports it on stderr by
// itself.
void requireWholePng(const fs::path& path) {
  constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n";
  std::ifstream stream(path, std::ios::binary);
  char head[8] = {};
  if (!stream.read(head, 8) || std::string_view(head, 8) != kSignature) failImage(path, "is not a PNG file");
  const auto end = static_cast<int64_t>(fs::file_size(path));
  for (int64_t offset = 8; stream.read(head, 8);) {
    uint32_t length = 0;
    for (int i = 0; i < 4; ++i) length = length << 8 | static_cast<unsigned char>(head[i]);
    offset += 12 + int64_t{length};  // length, type, data, checksum
    if (offset > end) break;
    if (std::string_view(head + 4, 4) == "IEND") return;
    stream.seekg(offset);
  }
  failImage(path, "is damaged or truncated");
}

Input openInput(const fs::path& path) {
  Input input;
  input.format = imageFormatOf(path);
  requireReadableFile(path);
  if (input.format == ImageFormat::png) requireWholePng(path);
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);
  input.file = OIIO::ImageInput::open(path.string(), &config);
  if (!input.file) failImage(path, "is not a readable image: " + OIIO::geterror());
  input.spec = input.file->spec();
  const OIIO::ImageSpec& spec = input.spec;
  if (spec.deep) failImage(path, "holds deep data, which is not read");
  if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1) failImage(path, "has no pixels");
  if (spec.depth > 1) failImage(path, "is a volume, not an image");
  if (int64_t{spec.width} * spec.height > kMaxPixels || spec.nchannels > kMaxChannels) {
    failImage(path, "claims " + std::to_string(spec.width) + "x" + std::to_string(spec.height) +
                        " pixels, more than can be read");
  }
  return input;
}

// All channels of the data window as float, raw.
std::vector<float> readSamples(const fs::path& path, Input& input) {
  const OIIO::ImageSpec& spec = input.spec;
  std::vector<float> samples(static_cast<size_t>(spec.width) * spec.height * spec.nchannels);
  if (!input.file->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, samples.data())) {
    failImage(path, "is damaged or truncated: " + input.file->geterror());
  }
  return samples;
}

// Channel of that name, or of that name in the only layer that has one ("beauty.R"); -1 when there is none.
int findChannel(const OIIO::ImageSpec& spec, std::string_view name) {
  int found = -1;
  for (int c = 0; c < spec.nchannels; ++c) {
    const std::string& candidate = spec.channelnames[static_cast<size_t>(c)];
    if (candidate == name) return c;
    const size_t dot = candidate.rfind('.');
    if (dot == std::string::npos || std::string_view(candidate).substr(dot + 1) != name) continue;
    if (found >= 0) return -1;
    found = c;
  }
  return found;
}

// Picks channels and places the data window into the display window, with zeros around it.
FloatImage pickChannels(const fs::path& path, const OIIO::ImageSpec& spec, const std::vector<float>& samples,
                        const std::vector<int>& channels) {
  const int64_t width = spec.full_width > 0 ? spec.full_width : spec.width;
  const int64_t height = spec.full_height > 0 ? spec.full_height : spec.height;
  if (width * height > kMaxPixels) failImage(path, "has a display window larger than can be read");
  FloatImage image(static_cast<uint32_t>(width), static_cast<uint32_t>(height), static_cast<uint32_t>(channels.size()));
  for (int y = 0; y < spec.height; ++y) {
    const int64_t targetY = int64_t{spec.y} + y - spec.full_y;
    if (targetY < 0 || targetY >= height) continue;
    for (int x = 0; x < spec.width; ++x) {
      const int64_t targetX = int64_t{spec.x} + x - spec.full_x;
      if (targetX < 0 || targetX >= width) continue;
      const float* source = samples.data() + (static_cast<size_t>(y) * spec.width + x) * spec.nchannels;
      float* target = image.pixel(static_cast<uint32_t>(targetX), static_cast<uint32_t>(targetY));
      for (size_t c = 0; c < channels.size(); ++c) target[c] = source[channels[c]];
    }
  }
  return image;
}

std::vector<int> colorChannels(const fs::path& path, const OIIO::ImageSpec& spec) {
  const int r = findChannel(spec, "R"), g = findChannel(spec, "G"), b = findChannel(spec, "B"),
            a = findChannel(spec, "A");
  if (r >= 0 && g >= 0 && b >= 0) return a >= 0 ? std::vector<int>{r, g, b, a} : std::vector<int>{r, g, b};
  if (spec.nchannels == 1) return {0};
  const int grey = findChannel(spec, "Y");
  if (grey >= 0) return a >= 0 ? std::vector<int>{grey, grey, grey, a} : std::vector<int>{grey};
  std::string names;
  for (const std::string& name : spec.channelnames) names += (names.empty() ? "" : ", ") + name;
  failImage(path, "has no colour channels R, G, B; it has " + names);
}

// PNG values to linear, premultiplied. Grey and RGB are encoded, alpha never is.
void decodePng(FloatImage& image, const OIIO::ImageSpec& spec) {
  const std::string space = spec.get_string_attribute("oiio:ColorSpace", "sRGB");
  const bool isEncoded = !OIIO::Strutil::iequals(space, "linear");
  const uint32_t colors = image.channels == 4 ? 3 : image.channels;
  for (size_t i = 0; i < image.pixelCount(); ++i) {
    float* p = image.samples.data() + i * image.channels;
    const float alpha = image.channels == 4 ? p[3] : 1.0f;
    for (uint32_t c = 0; c < colors; ++c) p[c] = (isEncoded ? linearFromSrgb(p[c]) : p[c]) * alpha;
  }
}

}  // namespace

FloatImage readImage(const fs::path& path) {
  try {
    Input input = openInput(path);
    const std::vector<int> channels = colorChannels(path, input.spec);
    const std::vector<float> samples = readSamples(path, input);
    FloatImage image = pickChannels(path, input.spec, samples, channels);
    if (input.format == ImageFormat::png) decodePng(image, input.spec);
    return image;
  } catch (const std::bad_alloc&) {
    failImage(path, "does not fit into memory", {}, ErrorKind::failed);
  }
}

FloatImage readDepth(const fs::path& path) {
  try {
    Input input = openInput(path);
    if (input.format == ImageFormat::png)
      failImage(path, "PNG files cannot hold depth", "give depth as an EXR with a channel Z");
    int channel = -1;
    for (const char* name : {"Z", "depth", "Depth", "Y", "V"}) {
      if (channel < 0) channel = findChannel(input.spec, name);
    }
    if (channel < 0 && input.spec.nchannels == 1) channel = 0;
    if (channel < 0) channel = findChannel(input.spec, "R");
    if (channel < 0) failImage(path, "has no depth channel", "name it Z");
    const std::vector<float> samples = readSamples(path, input);
    return pickChannels(path, input.spec, samples, {channel});
  } catch (const std::bad_alloc&) {
    failImage(path, "does not fit into memory", {}, ErrorKind::failed);
  }
}

}  // namespace lensgraph::engine
