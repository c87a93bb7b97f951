// Reads and writes picture files with OpenImageIO. See image_io.h for the conventions.
//
// OpenImageIO is asked for raw values everywhere: alpha is never multiplied for us (oiio:UnassociatedAlpha)
// and no colour space is converted; sRGB and premultiplication are done here, in linear light, where
// OpenImageIO would do them encoded.
#include "engine/image/image_io.h"

#include <OpenImageIO/imageio.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <memory>
#include <new>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "engine/error.h"
#include "engine/image/metrics.h"

namespace lensgraph::engine {
namespace {

namespace fs = std::filesystem;

// More pixels than this are taken for a damaged header: 16384 x 16384 is the largest picture of today's
// devices.
constexpr int64_t kMaxPixels = int64_t{1} << 28;
constexpr int kMaxChannels = 1024;

enum class Format { exr, png, hdr };

[[noreturn]] void fail(const fs::path& path, const std::string& reason, const std::string& remedy = {},
                       ErrorKind kind = ErrorKind::badInput) {
  throw Error(ErrorParts{.file = path.string(), .field = {}, .reason = reason, .remedy = remedy}, kind);
}

Format formatOf(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  if (extension == ".exr") return Format::exr;
  if (extension == ".png") return Format::png;
  if (extension == ".hdr") return Format::hdr;
  fail(path,
       extension.empty() ? "has no extension to tell the image format" : "unknown image format '" + extension + "'",
       "use .exr, .png or .hdr");
}

// ---- Reading

struct Input {
  std::unique_ptr<OIIO::ImageInput> file;
  OIIO::ImageSpec spec;  ///< A copy: the file's own may change while reading.
  Format format;
};

void requireReadableFile(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) fail(path, "no such file");
  if (fs::is_directory(status)) fail(path, "is a folder, not an image");
  const auto bytes = fs::file_size(path, error);
  if (!error && bytes == 0) fail(path, "is empty (0 bytes)");
}

// Walks the chunks of a PNG to its end. libpng would find a truncated file too, but reports it on stderr by
// itself.
void requireWholePng(const fs::path& path) {
  constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n";
  std::ifstream stream(path, std::ios::binary);
  char head[8] = {};
  if (!stream.read(head, 8) || std::string_view(head, 8) != kSignature) fail(path, "is not a PNG file");
  const auto end = static_cast<int64_t>(fs::file_size(path));
  for (int64_t offset = 8; stream.read(head, 8);) {
    uint32_t length = 0;
    for (int i = 0; i < 4; ++i) length = length << 8 | static_cast<unsigned char>(head[i]);
    offset += 12 + int64_t{length};  // length, type, data, checksum
    if (offset > end) break;
    if (std::string_view(head + 4, 4) == "IEND") return;
    stream.seekg(offset);
  }
  fail(path, "is damaged or truncated");
}

Input openInput(const fs::path& path) {
  Input input;
  input.format = formatOf(path);
  requireReadableFile(path);
  if (input.format == Format::png) requireWholePng(path);
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);
  input.file = OIIO::ImageInput::open(path.string(), &config);
  if (!input.file) fail(path, "is not a readable image: " + OIIO::geterror());
  input.spec = input.file->spec();
  const OIIO::ImageSpec& spec = input.spec;
  if (spec.deep) fail(path, "holds deep data, which is not read");
  if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1) fail(path, "has no pixels");
  if (spec.depth > 1) fail(path, "is a volume, not an image");
  if (int64_t{spec.width} * spec.height > kMaxPixels || spec.nchannels > kMaxChannels) {
    fail(path,
         "claims " + std::to_string(spec.width) + "x" + std::to_string(spec.height) + " pixels, more than can be read");
  }
  return input;
}

// All channels of the data window as float, raw.
std::vector<float> readSamples(const fs::path& path, Input& input) {
  const OIIO::ImageSpec& spec = input.spec;
  std::vector<float> samples(static_cast<size_t>(spec.width) * spec.height * spec.nchannels);
  if (!input.file->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, samples.data())) {
    fail(path, "is damaged or truncated: " + input.file->geterror());
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
  if (width * height > kMaxPixels) fail(path, "has a display window larger than can be read");
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
  fail(path, "has no colour channels R, G, B; it has " + names);
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

// ---- Writing

// A file beside the destination that disappears unless it is renamed into place.
class TemporaryFile {
 public:
  explicit TemporaryFile(const fs::path& destination) : destination_(destination) {
    static std::atomic<unsigned> counter{0};
    // Hidden and unique to the process; the extension stays, because it chooses the format.
    path_ = destination.parent_path() / ("." + destination.stem().string() + "." + std::to_string(::getpid()) + "-" +
                                         std::to_string(counter++) + ".tmp" + destination.extension().string());
  }
  ~TemporaryFile() {
    std::error_code ignored;
    if (!isPlaced_) fs::remove(path_, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const fs::path& path() const { return path_; }
  void place() {
    std::error_code error;
    fs::rename(path_, destination_, error);
    if (error) fail(destination_, "cannot be written: " + error.message(), "choose another file");
    isPlaced_ = true;
  }

 private:
  fs::path destination_, path_;
  bool isPlaced_ = false;
};

std::vector<uint8_t> encodePng(const FloatImage& image, double exposureEv) {
  const float gain = static_cast<float>(std::exp2(exposureEv));
  const auto quantised = [](float v) { return static_cast<uint8_t>(std::lround(255.0f * std::clamp(v, 0.0f, 1.0f))); };
  std::vector<uint8_t> bytes(image.samples.size());
  const uint32_t colors = image.channels == 4 ? 3 : image.channels;
  for (size_t i = 0; i < image.pixelCount(); ++i) {
    const float* p = image.samples.data() + i * image.channels;
    uint8_t* target = bytes.data() + i * image.channels;
    const float alpha = image.channels == 4 ? p[3] : 1.0f;
    // Light without coverage (alpha 0) has no straight colour; it is kept as it is.
    const float scale = alpha > 0.0f && std::isfinite(alpha) ? gain / alpha : gain;
    for (uint32_t c = 0; c < colors; ++c) {
      const float exposed = p[c] * scale;
      // Written so that NaN becomes 0.
      target[c] = quantised(srgbFromLinear(exposed > 0.0f ? std::min(exposed, 1.0f) : 0.0f));
    }
    if (image.channels == 4) target[3] = quantised(alpha > 0.0f ? alpha : 0.0f);
  }
  return bytes;
}

// RGB of a picture with any of the legal channel counts, for formats without alpha.
std::vector<float> rgbSamples(const FloatImage& image) {
  std::vector<float> rgb(image.pixelCount() * 3);
  for (size_t i = 0; i < image.pixelCount(); ++i) {
    const float* p = image.samples.data() + i * image.channels;
    for (size_t c = 0; c < 3; ++c) rgb[i * 3 + c] = image.channels == 1 ? p[0] : p[c];
  }
  return rgb;
}

void writeSamples(const fs::path& destination, const OIIO::ImageSpec& spec, OIIO::TypeDesc type, const void* samples) {
  TemporaryFile temporary(destination);
  const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(temporary.path().string());
  if (!output) fail(destination, "cannot be written: " + OIIO::geterror());
  if (!output->open(temporary.path().string(), spec)) {
    fail(destination, "cannot be written: " + output->geterror(), "choose a folder that exists and can be written to");
  }
  const bool isWritten = output->write_image(type, samples);
  const std::string problem = isWritten ? "" : output->geterror();
  // A full disk often shows only when the last buffer is flushed.
  if (!output->close() || !isWritten) {
    fail(destination, "writing failed: " + (problem.empty() ? output->geterror() : problem), {}, ErrorKind::failed);
  }
  temporary.place();
}

}  // namespace

FloatImage readImage(const fs::path& path) {
  try {
    Input input = openInput(path);
    const std::vector<int> channels = colorChannels(path, input.spec);
    const std::vector<float> samples = readSamples(path, input);
    FloatImage image = pickChannels(path, input.spec, samples, channels);
    if (input.format == Format::png) decodePng(image, input.spec);
    return image;
  } catch (const std::bad_alloc&) {
    fail(path, "does not fit into memory", {}, ErrorKind::failed);
  }
}

FloatImage readDepth(const fs::path& path) {
  try {
    Input input = openInput(path);
    if (input.format == Format::png) fail(path, "PNG files cannot hold depth", "give depth as an EXR with a channel Z");
    int channel = -1;
    for (const char* name : {"Z", "depth", "Depth", "Y", "V"}) {
      if (channel < 0) channel = findChannel(input.spec, name);
    }
    if (channel < 0 && input.spec.nchannels == 1) channel = 0;
    if (channel < 0) channel = findChannel(input.spec, "R");
    if (channel < 0) fail(path, "has no depth channel", "name it Z");
    const std::vector<float> samples = readSamples(path, input);
    return pickChannels(path, input.spec, samples, {channel});
  } catch (const std::bad_alloc&) {
    fail(path, "does not fit into memory", {}, ErrorKind::failed);
  }
}

void writeImage(const fs::path& path, const FloatImage& image, const ImageWriteOptions& options) {
  const Format format = formatOf(path);
  if (image.isEmpty()) fail(path, "there are no pixels to write");
  if (image.channels != 1 && image.channels != 3 && image.channels != 4) {
    fail(path, "a picture of " + std::to_string(image.channels) + " channels cannot be written", "use 1, 3 or 4");
  }
  std::error_code error;
  if (fs::is_directory(path, error)) fail(path, "is a folder, not a file", "add a file name");

  const int width = static_cast<int>(image.width), height = static_cast<int>(image.height);
  const int channels = static_cast<int>(image.channels);
  switch (format) {
    case Format::exr: {
      const bool isHalf = options.exrSampleType == ExrSampleType::half16;
      OIIO::ImageSpec spec(width, height, channels, isHalf ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::FLOAT);
      if (channels == 1) spec.channelnames = {"Z"};
      spec.attribute("compression", "zip");
      spec.attribute("oiio:ColorSpace", "Linear");
      writeSamples(path, spec, OIIO::TypeDesc::FLOAT, image.samples.data());
      break;
    }
    case Format::png: {
      OIIO::ImageSpec spec(width, height, channels, OIIO::TypeDesc::UINT8);
      spec.attribute("oiio:ColorSpace", "sRGB");
      spec.attribute("oiio:UnassociatedAlpha", 1);
      writeSamples(path, spec, OIIO::TypeDesc::UINT8, encodePng(image, options.exposureEv).data());
      break;
    }
    case Format::hdr: {
      const OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::FLOAT);
      writeSamples(path, spec, OIIO::TypeDesc::FLOAT, rgbSamples(image).data());
      break;
    }
  }
}

}  // namespace lensgraph::engine
