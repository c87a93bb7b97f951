// Reads pictures: what image_io.h says, joined from the formats' readers and the choice of channels.
#include <array>
#include <limits>
#include <memory>
#include <new>
#include <span>
#include <string>
#include <vector>

#include "engine/error.h"
#include "engine/image/channel_choice.h"
#include "engine/image/image_bytes.h"
#include "engine/image/image_format.h"
#include "engine/image/image_io.h"
#include "engine/image/picture_file.h"
#include "engine/image/srgb.h"

namespace lensgraph::engine {
namespace {

namespace fs = std::filesystem;

std::unique_ptr<PictureFile> openPicture(const fs::path& path, ImageFormat format, std::vector<std::byte> bytes) {
  switch (format) {
    case ImageFormat::exr:
      return openExr(path, std::move(bytes));
    case ImageFormat::png:
      return openPng(path, std::move(bytes));
    case ImageFormat::hdr:
      return openHdr(path, std::move(bytes));
  }
  failImage(path, "is of an unknown format");
}

// Integers to linear, premultiplied light. Grey and RGB may be encoded, alpha never is.
void decodeIntegers(FloatImage& image, float largest, bool isEncoded) {
  const uint32_t colors = image.channels == 4 ? 3 : image.channels;
  for (size_t i = 0; i < image.pixelCount(); ++i) {
    float* p = image.samples.data() + i * image.channels;
    for (uint32_t c = 0; c < image.channels; ++c) p[c] /= largest;
    const float alpha = image.channels == 4 ? p[3] : 1.0f;
    for (uint32_t c = 0; c < colors; ++c) p[c] = (isEncoded ? linearFromSrgb(p[c]) : p[c]) * alpha;
  }
}

PictureRead readColor(const fs::path& path, PictureFile& file, const ChannelChoice& layer) {
  ChosenChannels choice = chooseColor(path, file.parts(), layer);
  FloatImage image = file.read(choice.part, choice.channels, 0.0f);
  const uint32_t largest = file.largestInteger();
  if (largest > 0) decodeIntegers(image, static_cast<float>(largest), file.isEncoded());
  return {std::move(image), std::move(choice.names), largest};
}

/// Programs write grey as three equal channels; which one is read then does not matter. `names` becomes the one read.
FloatImage readEqualChannels(const fs::path& path, PictureFile& file, const ChannelChoice& choice,
                             ChannelsRead& names) {
  constexpr std::array<size_t, 3> kRgb = {0, 1, 2};
  const FloatImage rgb = file.read(0, kRgb, 0.0f);
  FloatImage depth(rgb.width, rgb.height, 1);
  for (size_t i = 0; i < depth.samples.size(); ++i) {
    const float* p = rgb.samples.data() + 3 * i;
    if (p[0] != p[1] || p[0] != p[2]) {
      failImage(path, "is in colour; depth is one channel, or three equal ones",
                choice.option.empty() ? "" : "choose one with " + choice.option + " NAME");
    }
    depth.samples[i] = p[0];
  }
  names = {.part = {}, .layer = {}, .channels = {"R", "G", "B"}};
  return depth;
}

PictureRead readDepth(const fs::path& path, PictureFile& file, const ChannelChoice& channel) {
  constexpr float kNothingThere = std::numeric_limits<float>::infinity();
  const bool isPng = file.largestInteger() > 0;
  if (isPng) file.requireWholeSamples();
  if (isPng && channel.name.empty()) {
    ChannelsRead names{.part = {}, .layer = {}, .channels = {"Y"}};
    const bool isGrey = file.parts().front().channels.size() < 3;
    constexpr std::array<size_t, 1> kFirst = {0};
    FloatImage image = isGrey ? file.read(0, kFirst, 0.0f) : readEqualChannels(path, file, channel, names);
    return {std::move(image), std::move(names), file.largestInteger()};
  }
  ChosenChannels choice = chooseDepth(path, file.parts(), channel);
  return {file.read(choice.part, choice.channels, kNothingThere), std::move(choice.names), file.largestInteger()};
}

template <class Read>
PictureRead guarded(const fs::path& path, Read read) {
  try {
    return read();
  } catch (const std::bad_alloc&) {
    failImage(path, "does not fit into memory", {}, ErrorKind::failed);
  }
}

std::vector<std::byte> copyOf(const fs::path& path, std::span<const std::byte> bytes) {
  if (bytes.empty()) failImage(path, "is empty (0 bytes)");
  return {bytes.begin(), bytes.end()};
}

}  // namespace

void requireReadableSize(const fs::path& path, int64_t width, int64_t height) {
  if (width < 1 || height < 1) failImage(path, "has no pixels");
  if (width <= kMaxSide && height <= kMaxSide && width * height <= kMaxPixels) return;
  failImage(path, "is " + std::to_string(width) + "x" + std::to_string(height) + " px, larger than what is read (" +
                      std::to_string(kMaxSide) + " px a side, 2^28 pixels in all)");
}

PictureRead readImage(const fs::path& path, const ChannelChoice& layer) {
  return guarded(path, [&] {
    const ImageFormat format = imageFormatOf(path);
    return readColor(path, *openPicture(path, format, readImageBytes(path)), layer);
  });
}

PictureRead readDepth(const fs::path& path, const ChannelChoice& channel) {
  return guarded(path, [&] {
    const ImageFormat format = imageFormatOf(path);
    return readDepth(path, *openPicture(path, format, readImageBytes(path)), channel);
  });
}

PictureRead readImage(std::span<const std::byte> bytes, const fs::path& name, const ChannelChoice& layer) {
  return guarded(name,
                 [&] { return readColor(name, *openPicture(name, imageFormatOf(name), copyOf(name, bytes)), layer); });
}

PictureRead readDepth(std::span<const std::byte> bytes, const fs::path& name, const ChannelChoice& channel) {
  return guarded(
      name, [&] { return readDepth(name, *openPicture(name, imageFormatOf(name), copyOf(name, bytes)), channel); });
}

FloatImage readImage(const fs::path& path) {
  return readImage(path, ChannelChoice{}).image;
}

FloatImage readDepth(const fs::path& path) {
  return readDepth(path, ChannelChoice{}).image;
}

}  // namespace lensgraph::engine
