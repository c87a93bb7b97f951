// Writes picture files with OpenImageIO. See image_io.h for the conventions.
//
// OpenImageIO is asked for raw values: alpha is never multiplied for us (oiio:UnassociatedAlpha) and no colour space is
// converted; sRGB and premultiplication are done here, in linear light, where OpenImageIO would do them encoded.
#include <OpenImageIO/imageio.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include "engine/error.h"
#include "engine/image/image_format.h"
#include "engine/image/image_io.h"
#include "engine/image/metrics.h"

namespace lensgraph::engine {
namespace {

namespace fs = std::filesystem;

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
    if (error) failImage(destination_, "cannot be written: " + error.message(), "choose another file");
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
  if (!output) failImage(destination, "cannot be written: " + OIIO::geterror());
  if (!output->open(temporary.path().string(), spec)) {
    failImage(destination, "cannot be written: " + output->geterror(),
              "choose a folder that exists and can be written to");
  }
  const bool isWritten = output->write_image(type, samples);
  const std::string problem = isWritten ? "" : output->geterror();
  // A full disk often shows only when the last buffer is flushed.
  if (!output->close() || !isWritten) {
    failImage(destination, "writing failed: " + (problem.empty() ? output->geterror() : problem), {},
              ErrorKind::failed);
  }
  temporary.place();
}

}  // namespace

void writeImage(const fs::path& path, const FloatImage& image, const ImageWriteOptions& options) {
  const ImageFormat format = imageFormatOf(path);
  if (image.isEmpty()) failImage(path, "there are no pixels to write");
  if (image.channels != 1 && image.channels != 3 && image.channels != 4) {
    failImage(path, "a picture of " + std::to_string(image.channels) + " channels cannot be written", "use 1, 3 or 4");
  }
  std::error_code error;
  if (fs::is_directory(path, error)) failImage(path, "is a folder, not a file", "add a file name");

  const int width = static_cast<int>(image.width), height = static_cast<int>(image.height);
  const int channels = static_cast<int>(image.channels);
  switch (format) {
    case ImageFormat::exr: {
      const bool isHalf = options.exrSampleType == ExrSampleType::half16;
      OIIO::ImageSpec spec(width, height, channels, isHalf ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::FLOAT);
      if (channels == 1) spec.channelnames = {"Z"};
      spec.attribute("compression", "zip");
      spec.attribute("oiio:ColorSpace", "Linear");
      writeSamples(path, spec, OIIO::TypeDesc::FLOAT, image.samples.data());
      break;
    }
    case ImageFormat::png: {
      OIIO::ImageSpec spec(width, height, channels, OIIO::TypeDesc::UINT8);
      spec.attribute("oiio:ColorSpace", "sRGB");
      spec.attribute("oiio:UnassociatedAlpha", 1);
      writeSamples(path, spec, OIIO::TypeDesc::UINT8, encodePng(image, options.exposureEv).data());
      break;
    }
    case ImageFormat::hdr: {
      const OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::FLOAT);
      writeSamples(path, spec, OIIO::TypeDesc::FLOAT, rgbSamples(image).data());
      break;
    }
  }
}

}  // namespace lensgraph::engine
