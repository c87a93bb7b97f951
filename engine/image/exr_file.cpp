// Reads EXR files: see picture_file.h. The headers are checked here; OpenImageIO reads the pixels.
#include <algorithm>
#include <string>

#include "engine/image/exr_header.h"
#include "engine/image/image_format.h"
#include "engine/image/oiio_input.h"
#include "engine/image/picture_file.h"

namespace lensgraph::engine {
namespace {

namespace fs = std::filesystem;

/// The part of `window` that lies in `frame`, as offsets from the window's start.
struct Overlap {
  int64_t begin, end;
};
Overlap overlap(int64_t window, int64_t size, int64_t frame, int64_t frameSize) {
  return {std::max<int64_t>(0, frame - window), std::min(size, frame + frameSize - window)};
}

class ExrFile : public PictureFile {
 public:
  ExrFile(const fs::path& path, std::vector<std::byte> bytes)
      : path_(path), bytes_(std::move(bytes)), headers_(readExrHeaders(path, bytes_)) {
    for (const ExrPart& header : headers_) {
      PicturePart part{.name = headers_.size() > 1 ? header.name : "", .channels = {}, .isDeep = header.isDeep};
      for (const ExrChannel& channel : header.channels) part.channels.push_back(channel.name);
      parts_.push_back(std::move(part));
    }
  }

  FloatImage read(size_t part, std::span<const size_t> channels, float outside) override {
    const ExrPart& header = headers_[part];
    requireFullResolution(header);
    OiioInput input(path_, "openexr", bytes_);
    const OIIO::ImageSpec& spec = input.select(part);
    if (spec.deep || spec.width != header.data.width || spec.height != header.data.height) {
      failImage(path_, "is damaged or truncated: its headers contradict each other");
    }
    FloatImage image;
    image.width = static_cast<uint32_t>(header.display.width);
    image.height = static_cast<uint32_t>(header.display.height);
    image.channels = static_cast<uint32_t>(channels.size());
    // Where each wanted channel stands in OpenImageIO's order, and neighbours of one type together: every reading
    // decompresses the whole file, and channels that are not wanted cost memory.
    std::vector<std::pair<int, size_t>> wanted;
    for (size_t c = 0; c < channels.size(); ++c) wanted.emplace_back(indexIn(spec, header.channels[channels[c]]), c);
    std::ranges::sort(wanted);
    for (auto first = wanted.begin(); first != wanted.end();) {
      auto end = first + 1;
      while (end != wanted.end() && end->first == (end - 1)->first + 1 && sameKind(spec, first->first, end->first)) {
        ++end;
      }
      std::vector<float> samples = input.read(first->first, (end - 1)->first + 1);
      if (isWhole(header, {first, end}, channels.size())) {  // spares a copy of all
        image.samples = std::move(samples);
        return image;
      }
      image.samples.resize(image.pixelCount() * image.channels, outside);
      place(image, header, samples, {first, end});
      first = end;
    }
    return image;
  }

 private:
  void requireFullResolution(const ExrPart& header) const {
    for (const ExrChannel& channel : header.channels) {
      if (!channel.isSubsampled) continue;
      failImage(path_,
                "has channels of less than full resolution ('" + channel.name +
                    "'; luminance and chroma?), which are not read",
                "store it as R, G, B");
    }
  }

  int indexIn(const OIIO::ImageSpec& spec, const ExrChannel& channel) const {
    const int index = spec.channelindex(channel.name);
    if (index < 0) failImage(path_, "has a channel '" + channel.name + "' that cannot be read");
    return index;
  }

  static bool sameKind(const OIIO::ImageSpec& spec, int a, int b) {
    const auto isInteger = [&](int c) { return spec.channelformat(c) == OIIO::TypeDesc::UINT32; };
    return isInteger(a) == isInteger(b);
  }

  /// Whether those channels are all that are wanted, in their order, and cover the display window.
  static bool isWhole(const ExrPart& header, std::span<const std::pair<int, size_t>> wanted, size_t channels) {
    const auto same = [](const ExrWindow& a, const ExrWindow& b) {
      return a.x == b.x && a.y == b.y && a.width == b.width && a.height == b.height;
    };
    return wanted.size() == channels && same(header.data, header.display) &&
           std::ranges::is_sorted(wanted, {}, &std::pair<int, size_t>::second);
  }

  /// Copies neighbouring channels of the data window to where they belong in the display window.
  static void place(FloatImage& image, const ExrPart& header, const std::vector<float>& samples,
                    std::span<const std::pair<int, size_t>> wanted) {
    const auto [left, right] = overlap(header.data.x, header.data.width, header.display.x, header.display.width);
    const auto [top, bottom] = overlap(header.data.y, header.data.height, header.display.y, header.display.height);
    for (int64_t y = top; y < bottom; ++y) {
      for (int64_t x = left; x < right; ++x) {
        const float* source = samples.data() + static_cast<size_t>(y * header.data.width + x) * wanted.size();
        float* target = image.pixel(static_cast<uint32_t>(header.data.x + x - header.display.x),
                                    static_cast<uint32_t>(header.data.y + y - header.display.y));
        for (const auto& [index, channel] : wanted) target[channel] = *source++;
      }
    }
  }

  fs::path path_;
  std::vector<std::byte> bytes_;
  std::vector<ExrPart> headers_;
};

}  // namespace

std::unique_ptr<PictureFile> openExr(const fs::path& path, std::vector<std::byte> bytes) {
  return std::make_unique<ExrFile>(path, std::move(bytes));
}

}  // namespace lensgraph::engine
