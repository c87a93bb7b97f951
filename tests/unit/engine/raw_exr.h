// Writes EXR files byte by byte (OpenEXR File Layout, uncompressed lines): any channels, parts and attributes, right or
// wrong, so that readers have an outside judge.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace lensgraph::test {

/// One channel of one value everywhere, or of one value a pixel.
struct ExrChannelData {
  std::string name;
  std::vector<float> values;  ///< One, or width · height.
  uint32_t sampling = 1;      ///< As the header claims; the data are never subsampled.
  bool isInteger = false;     ///< Written as 32-bit unsigned.
};

struct ExrAttribute {
  std::string name, type, value;
};

struct ExrPartData {
  std::string name;
  std::vector<ExrChannelData> channels;
  int32_t width = 2, height = 2;  ///< px
  std::string type = "scanlineimage";
  std::vector<ExrAttribute> attributes;         ///< Beside the required ones; replacing them where names are equal.
  int32_t dataX = 0, dataY = 0;                 ///< px; where the data window begins.
  int32_t displayWidth = 0, displayHeight = 0;  ///< px; 0: as the data window.
};

class ExrWriter {
 public:
  /// Little-endian.
  static std::string word(uint32_t value) {
    std::string text(4, '\0');
    for (int i = 0; i < 4; ++i) text[static_cast<std::size_t>(i)] = static_cast<char>(value >> (8 * i));
    return text;
  }
  static std::string number(float value) {
    uint32_t bits = 0;
    std::memcpy(&bits, &value, 4);
    return word(bits);
  }
  static std::string box(int32_t x, int32_t y, int32_t width, int32_t height) {
    return word(static_cast<uint32_t>(x)) + word(static_cast<uint32_t>(y)) +
           word(static_cast<uint32_t>(x + width - 1)) + word(static_cast<uint32_t>(y + height - 1));
  }

  static std::string header(const ExrPartData& part, bool isMulti) {
    std::string channels;
    for (const auto& channel : sorted(part)) {
      channels += channel.name + '\0' + word(channel.isInteger ? 0 : 2) + word(0) + word(channel.sampling) +
                  word(channel.sampling);
    }
    channels += '\0';
    const int32_t width = part.displayWidth ? part.displayWidth : part.width;
    const int32_t height = part.displayHeight ? part.displayHeight : part.height;
    std::vector<ExrAttribute> all = {{"channels", "chlist", channels},
                                     {"compression", "compression", std::string(1, '\0')},
                                     {"dataWindow", "box2i", box(part.dataX, part.dataY, part.width, part.height)},
                                     {"displayWindow", "box2i", box(0, 0, width, height)},
                                     {"lineOrder", "lineOrder", std::string(1, '\0')},
                                     {"pixelAspectRatio", "float", number(1.0f)},
                                     {"screenWindowCenter", "v2f", number(0.0f) + number(0.0f)},
                                     {"screenWindowWidth", "float", number(1.0f)}};
    if (isMulti) {
      all.push_back({"name", "string", part.name});
      all.push_back({"type", "string", part.type});
      all.push_back({"chunkCount", "int", word(static_cast<uint32_t>(part.height))});
    }
    for (const auto& extra : part.attributes) {
      std::erase_if(all, [&](const auto& each) { return each.name == extra.name; });
      all.push_back(extra);
    }
    std::string text;
    for (const auto& each : all) {
      text += each.name + '\0' + each.type + '\0' + word(static_cast<uint32_t>(each.value.size())) + each.value;
    }
    return text + '\0';
  }

  static std::vector<uint8_t> file(const std::vector<ExrPartData>& parts, uint32_t flags = 0) {
    const bool isMulti = parts.size() > 1;
    std::string text = word(20000630) + word(2 | flags | (isMulti ? 0x1000u : 0u));
    for (const auto& part : parts) text += header(part, isMulti);
    if (isMulti) text += '\0';
    std::size_t lines = 0;
    for (const auto& part : parts) lines += static_cast<std::size_t>(part.height);
    const std::size_t pixels = text.size() + 8 * lines;
    std::string offsets, chunks;
    for (std::size_t p = 0; p < parts.size(); ++p) {
      for (int32_t y = 0; y < parts[p].height; ++y) {
        offsets += word(static_cast<uint32_t>(pixels + chunks.size())) + word(0);
        const std::string data = line(parts[p], y);
        if (isMulti) chunks += word(static_cast<uint32_t>(p));
        chunks += word(static_cast<uint32_t>(y + parts[p].dataY)) + word(static_cast<uint32_t>(data.size())) + data;
      }
    }
    text += offsets + chunks;
    return {text.begin(), text.end()};
  }

 private:
  static std::vector<ExrChannelData> sorted(const ExrPartData& part) {
    auto channels = part.channels;
    std::ranges::sort(channels, {}, &ExrChannelData::name);
    return channels;
  }
  static std::string line(const ExrPartData& part, int32_t y) {
    std::string text;
    for (const auto& channel : sorted(part)) {
      for (int32_t x = 0; x < part.width; ++x) {
        const auto index = static_cast<std::size_t>(y * part.width + x);
        const float value = channel.values.size() > 1 ? channel.values[index] : channel.values.at(0);
        text += channel.isInteger ? word(static_cast<uint32_t>(value)) : number(value);
      }
    }
    return text;
  }
};

/// A file of one part with channels of one value each.
inline std::vector<uint8_t> rawExr(const std::vector<std::pair<std::string, float>>& channels) {
  ExrPartData part;
  for (const auto& [name, value] : channels) part.channels.push_back({name, {value}});
  return ExrWriter::file({part});
}

}  // namespace lensgraph::test
