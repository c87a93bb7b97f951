// Damages files: see mutator.h.
#include "mutator.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <string_view>

namespace lensgraph::fuzz {
namespace {

constexpr std::size_t kMostBytes = std::size_t{1} << 20;

/// Limits of types, and what overflows when it is multiplied.
constexpr uint64_t kNumbers[] = {
    0,     1,     2,     3,          127,        128,        255,        256,        4096,     32767,
    32768, 65535, 65536, 0x7fffffff, 0x80000000, 0xffffffff, 0x40000000, 0x10000001, 16777216, 0xfffffffffffffff0};
constexpr std::string_view kJsonValues[] = {
    "-1",  "0",    "1e999", "-1e30", "1e-40",   "4294967296", "9007199254740993",
    "0.5", "null", "true",  "[]",    "{}",      "\"\"",       "\"\\u0000\"",
    "3.0", "1.5",  "255",   "65536", "[[[1]]]", "2147483648"};

void insert(Bytes& bytes, std::size_t at, std::string_view text) {
  bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(at), text.begin(), text.end());
}
void erase(Bytes& bytes, std::size_t at, std::size_t count) {
  const auto first = bytes.begin() + static_cast<std::ptrdiff_t>(at);
  bytes.erase(first, first + static_cast<std::ptrdiff_t>(std::min(count, bytes.size() - at)));
}

/// Writes a number of 2, 4 or 8 bytes over what is there.
void overwriteNumber(Bytes& bytes, Random& random) {
  const std::size_t size = std::size_t{2} << pick(random, 3);
  if (bytes.size() < size) return;
  const uint64_t number = kNumbers[pick(random, std::size(kNumbers))];
  const std::size_t at = pick(random, bytes.size() - size + 1);
  const bool isBigEndian = pick(random, 2) == 0;
  for (std::size_t i = 0; i < size; ++i) {
    bytes[at + i] = static_cast<uint8_t>(number >> 8 * (isBigEndian ? size - 1 - i : i));
  }
}

/// Replaces a JSON number or string, found from a random place on.
void replaceJsonValue(Bytes& bytes, Random& random) {
  const auto isNumber = [](uint8_t c) { return std::isdigit(c) != 0 || c == '-' || c == '.' || c == 'e' || c == '+'; };
  std::size_t at = pick(random, bytes.size());
  while (at < bytes.size() && !isNumber(bytes[at])) ++at;
  std::size_t end = at;
  while (end < bytes.size() && isNumber(bytes[end])) ++end;
  if (end == at) return;
  erase(bytes, at, end - at);
  insert(bytes, at, kJsonValues[pick(random, std::size(kJsonValues))]);
}

void change(Bytes& bytes, const std::vector<Bytes>& seeds, Random& random) {
  if (bytes.empty()) bytes.push_back(0);
  const std::size_t at = pick(random, bytes.size());
  switch (pick(random, 9)) {
    case 0:
      bytes[at] ^= static_cast<uint8_t>(1u << pick(random, 8));
      return;
    case 1:
      bytes[at] = static_cast<uint8_t>(pick(random, 256));
      return;
    case 2:
      return overwriteNumber(bytes, random);
    case 3:
      return erase(bytes, at, 1 + pick(random, 64));
    case 4:
      return bytes.resize(at);
    case 5: {
      const std::size_t count = std::min(bytes.size() - at, 1 + pick(random, 256));
      const Bytes copy(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                       bytes.begin() + static_cast<std::ptrdiff_t>(at + count));
      return insert(bytes, pick(random, bytes.size()), {reinterpret_cast<const char*>(copy.data()), copy.size()});
    }
    case 6: {
      const Bytes& other = seeds[pick(random, seeds.size())];
      if (other.empty()) return;
      const std::size_t from = pick(random, other.size()), count = std::min(other.size() - from, pick(random, 4096));
      return insert(bytes, at, {reinterpret_cast<const char*>(other.data()) + from, count});
    }
    default:
      return replaceJsonValue(bytes, random);
  }
}

uint32_t bigEndian32(const Bytes& bytes, std::size_t at) {
  return uint32_t{bytes[at]} << 24 | uint32_t{bytes[at + 1]} << 16 | uint32_t{bytes[at + 2]} << 8 | bytes[at + 3];
}

/// CRC-32 of PNG (ISO 3309).
uint32_t checksum(const uint8_t* data, std::size_t count) {
  uint32_t crc = 0xffffffffu;
  for (std::size_t i = 0; i < count; ++i) {
    crc ^= data[i];
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (0xedb88320u & (0u - (crc & 1u)));
  }
  return ~crc;
}

void mendPng(Bytes& bytes) {
  for (std::size_t at = 8; at + 12 <= bytes.size();) {
    const std::size_t length = bigEndian32(bytes, at);
    if (length > bytes.size() - at - 12) return;
    const uint32_t crc = checksum(bytes.data() + at + 4, length + 4);
    for (std::size_t i = 0; i < 4; ++i) bytes[at + 8 + length + i] = static_cast<uint8_t>(crc >> (24 - 8 * i));
    at += 12 + length;
  }
}

void mendGlb(Bytes& bytes) {
  const auto put = [&](std::size_t at, std::size_t number) {
    for (std::size_t i = 0; i < 4; ++i) bytes[at + i] = static_cast<uint8_t>(number >> 8 * i);
  };
  if (bytes.size() < 20) return;
  put(8, bytes.size());
  // The JSON chunk ends at its last brace before the type of the binary chunk.
  static constexpr std::string_view kBinary{"BIN\0", 4};
  const auto binary = std::search(bytes.begin() + 20, bytes.end(), kBinary.begin(), kBinary.end());
  if (binary == bytes.end() || binary - bytes.begin() < 24) return;
  const auto at = static_cast<std::size_t>(binary - bytes.begin()) - 4;
  put(12, at - 20);
  put(at, bytes.size() - at - 8);
}

}  // namespace

std::size_t pick(Random& random, std::size_t count) {
  return static_cast<std::size_t>(random() % count);
}

Bytes mutated(const std::vector<Bytes>& seeds, Random& random) {
  Bytes bytes = seeds[pick(random, seeds.size())];
  const std::size_t changes = 1 + pick(random, 8);
  for (std::size_t i = 0; i < changes; ++i) change(bytes, seeds, random);
  if (bytes.size() > kMostBytes) bytes.resize(kMostBytes);
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (pick(random, 5) != 0) {
    if (text.starts_with("\x89PNG")) mendPng(bytes);
    if (text.starts_with("glTF")) mendGlb(bytes);
  }
  return bytes;
}

}  // namespace lensgraph::fuzz
