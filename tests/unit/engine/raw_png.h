// Writes PNG files byte by byte (RFC 2083, deflate's stored blocks): the tests' own, so that readers have an
// outside judge.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <vector>

namespace lensgraph::test {

inline void appendBigEndian(std::vector<uint8_t>& bytes, uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(static_cast<uint8_t>(value >> shift));
}

inline uint32_t crcOf(const std::vector<uint8_t>& bytes, size_t start) {
  uint32_t crc = 0xFFFFFFFFu;
  for (size_t i = start; i < bytes.size(); ++i) {
    crc ^= bytes[i];
    for (int k = 0; k < 8; ++k) crc = crc & 1 ? 0xEDB88320u ^ (crc >> 1) : crc >> 1;
  }
  return ~crc;
}

inline void appendChunk(std::vector<uint8_t>& png, std::string_view type, const std::vector<uint8_t>& data) {
  appendBigEndian(png, static_cast<uint32_t>(data.size()));
  const size_t start = png.size();
  png.insert(png.end(), type.begin(), type.end());
  png.insert(png.end(), data.begin(), data.end());
  appendBigEndian(png, crcOf(png, start));
}

enum class PngColor : uint8_t { grey = 0, rgb = 2, greyAlpha = 4, rgba = 6 };

/// `samples` row by row, 8 or 16 bits each (`depth`), as many per pixel as the colour type has. Small
/// pictures only.
inline std::vector<uint8_t> rawPng(uint32_t width, uint32_t height, int depth, PngColor color,
                                   const std::vector<uint16_t>& samples) {
  std::vector<uint8_t> rows;
  const size_t perRow = std::max<size_t>(samples.size() / height, 1);
  for (size_t i = 0; i < samples.size(); ++i) {
    if (i % perRow == 0) rows.push_back(0);  // no filter
    if (depth == 16) rows.push_back(static_cast<uint8_t>(samples[i] >> 8));
    rows.push_back(static_cast<uint8_t>(samples[i] & 0xFF));
  }
  uint32_t a = 1, b = 0;  // Adler-32
  for (uint8_t byte : rows) {
    a = (a + byte) % 65521;
    b = (b + a) % 65521;
  }
  const uint16_t length = static_cast<uint16_t>(rows.size());
  std::vector<uint8_t> data = {0x78,
                               0x01,
                               0x01,
                               static_cast<uint8_t>(length & 0xFF),
                               static_cast<uint8_t>(length >> 8),
                               static_cast<uint8_t>(~length & 0xFF),
                               static_cast<uint8_t>(~length >> 8 & 0xFF)};
  data.insert(data.end(), rows.begin(), rows.end());
  appendBigEndian(data, b << 16 | a);

  std::vector<uint8_t> header;
  appendBigEndian(header, width);
  appendBigEndian(header, height);
  header.insert(header.end(), {static_cast<uint8_t>(depth), static_cast<uint8_t>(color), 0, 0, 0});
  std::vector<uint8_t> png = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
  appendChunk(png, "IHDR", header);
  appendChunk(png, "IDAT", data);
  appendChunk(png, "IEND", {});
  return png;
}

}  // namespace lensgraph::test
