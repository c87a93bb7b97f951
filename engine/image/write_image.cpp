// Writes picture files with OpenImageIO. See image_io.h for the conventions.
//
// OpenImageIO is asked for raw values: alpha is never multiplied for us (oiio:UnassociatedAlpha) and no colour space is
// converted; sRGB and premultiplication are done here, in linear light, where OpenImageIO would do them encoded.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/error.h"
#include "engine/files/output_file.h"
#include "engine/image/image_format.h"
#include "engine/image/image_io.h"
#include "engine/image/srgb.h"

namespace lensgraph::engine {
namespace {

namespace fs = std::filesystem;

// What OpenImageIO writes to instead of a file of its own, whose errors it partly ignores: a full disk would show only as
// a picture that is too short. Never reports an error to it either, because libpng would print one on stderr; the first
// failure is kept, and nothing is written after it.
class OutputProxy : public OIIO::Filesystem::IOProxy {
 public:
  explicit OutputProxy(OutputFile& file) : IOProxy("", Write), file_(file) {}
  const char* proxytype() const override { return "lensgraph output"; }
  size_t write(const void* bytes, size_t count) override {
    pwrite(bytes, count, m_pos);
    m_pos += static_cast<int64_t>(count);
    return count;
  }
  size_t pwrite(const void* bytes, size_t count, int64_t offset) override {
    if (failure_) return count;
    try {
      file_.write(std::span(static_cast<const std::byte*>(bytes), count), static_cast<uint64_t>(offset));
    } catch (...) {
      failure_ = std::current_exception();
    }
    return count;
  }
  size_t size() const override { return file_.size(); }

  void rethrowFailure() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  OutputFile& file_;
  std::exception_ptr failure_;
};

/// The samples of an 8-bit PNG file.
std::vector<uint8_t> pngSamples(const FloatImage& image, double exposureEv) {
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

[[noreturn]] void failEncoding(const fs::path& destination, const std::string& problem) {
  // OpenImageIO gives no reason where it cannot make its threads.
  failImage(destination, "encoding failed: " + (problem.empty() ? "memory or threads are short" : problem), {},
            ErrorKind::failed);
}

void writeSamples(const fs::path& destination, const OIIO::ImageSpec& spec, OIIO::TypeDesc type, const void* samples) {
  OutputFile file(destination);
  OutputProxy proxy(file);
  // Of the name only the extension counts, which chooses the format.
  const std::string name = "x" + destination.extension().string();
  const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(name);
  if (!output) failEncoding(destination, OIIO::geterror());
  const bool isWritten = output->set_ioproxy(&proxy) && output->open(name, spec) && output->write_image(type, samples);
  std::string problem = isWritten ? "" : output->geterror();
  // PNG files end only here; the proxy must still be there.
  const bool isClosed = output->close();
  proxy.rethrowFailure();
  if (!isWritten || !isClosed) failEncoding(destination, problem.empty() ? output->geterror() : problem);
  file.place();
}

OIIO::ImageSpec pngSpec(const FloatImage& image) {
  OIIO::ImageSpec spec(static_cast<int>(image.width), static_cast<int>(image.height), static_cast<int>(image.channels),
                       OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  spec.attribute("oiio:UnassociatedAlpha", 1);
  return spec;
}

void requireWritable(const fs::path& path, const FloatImage& image) {
  if (image.isEmpty()) failImage(path, "there are no pixels to write");
  if (image.channels != 1 && image.channels != 3 && image.channels != 4) {
    failImage(path, "a picture of " + std::to_string(image.channels) + " channels cannot be written", "use 1, 3 or 4");
  }
}

}  // namespace

std::vector<unsigned char> encodePng(const FloatImage& image, double exposureEv) {
  const fs::path name = "picture.png";  // For messages of errors.
  requireWritable(name, image);
  std::vector<unsigned char> file;
  OIIO::Filesystem::IOVecOutput proxy(file);
  const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create("png");
  if (!output) failEncoding(name, OIIO::geterror());
  const bool isWritten = output->set_ioproxy(&proxy) && output->open(name.string(), pngSpec(image)) &&
                         output->write_image(OIIO::TypeDesc::UINT8, pngSamples(image, exposureEv).data());
  if (!isWritten || !output->close()) failEncoding(name, output->geterror());
  return file;
}

void writeImage(const fs::path& path, const FloatImage& image, const ImageWriteOptions& options) {
  const ImageFormat format = imageFormatOf(path);
  requireWritable(path, image);
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
      writeSamples(path, pngSpec(image), OIIO::TypeDesc::UINT8, pngSamples(image, options.exposureEv).data());
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
