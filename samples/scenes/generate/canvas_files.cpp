// Encoding of canvases through OpenImageIO; no attribute that differs from run to run is written.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "generate/canvas.h"

namespace scenes {
namespace {

uint8_t toByte(float value) {
  return static_cast<uint8_t>(std::lround(std::clamp(value, 0.0f, 1.0f) * 255.0f));
}

}  // namespace

std::vector<uint8_t> encodePng(const Canvas& canvas, bool alpha, int level) {
  const int channels = alpha ? 4 : 3;
  std::vector<uint8_t> bytes;
  for (int y = 0; y < canvas.height(); ++y) {
    for (int x = 0; x < canvas.width(); ++x) {
      for (int c = 0; c < channels; ++c) bytes.push_back(toByte(canvas.at(x, y)[c]));
    }
  }
  std::vector<unsigned char> file;
  OIIO::Filesystem::IOVecOutput memory(file);
  OIIO::ImageSpec spec(canvas.width(), canvas.height(), channels, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  spec.attribute("oiio:UnassociatedAlpha", 1);
  spec.attribute("png:compressionLevel", level);
  const auto output = OIIO::ImageOutput::create("texture.png", &memory);
  if (!output || !output->open("texture.png", spec) || !output->write_image(OIIO::TypeDesc::UINT8, bytes.data()) ||
      !output->close()) {
    throw std::runtime_error("PNG encoding failed: " + (output ? output->geterror() : OIIO::geterror()));
  }
  return file;
}

void writeExr(const std::filesystem::path& file, int width, int height, const std::vector<glm::vec3>& radiance) {
  OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::HALF);
  spec.attribute("compression", "zip");
  spec.attribute("DateTime", "1970:01:01 00:00:00");  // Otherwise the writer stamps the current time.
  const auto output = OIIO::ImageOutput::create(file.string());
  if (!output || !output->open(file.string(), spec) || !output->write_image(OIIO::TypeDesc::FLOAT, radiance.data()) ||
      !output->close()) {
    throw std::runtime_error(file.string() + ": " + (output ? output->geterror() : OIIO::geterror()));
  }
}

}  // namespace scenes
