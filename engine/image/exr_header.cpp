// Parsing of OpenEXR headers: see exr_header.h. After "OpenEXR File Layout", version 2.
#include "engine/image/exr_header.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <optional>
#include <set>
#include <string_view>

#include "engine/image/image_format.h"
#include "engine/image/picture_file.h"

namespace lensgraph::engine {
namespace {

namespace fs = std::filesystem;

constexpr uint32_t kMagic = 20000630;
constexpr uint32_t kTiled = 0x200, kLongNames = 0x400, kNonImage = 0x800, kMultiPart = 0x1000;
constexpr size_t kMaxParts = 1024;

/// How a compression groups lines, and the most bytes that one byte of it can become: deflate gives 1032 (PXR24 drops a
/// quarter before it), run lengths 64, PIZ's Huffman code 410 on a constant picture, B44 and B44A 32 of 14 and 3. DWA codes
/// 8 x 8 pixels of a constant picture as two numbers, by Huffman and deflate.
struct Compression {
  int64_t lines;
  uint64_t ratio;
};
constexpr Compression kCompressions[] = {{1, 1},     {1, 64}, {1, 1032}, {16, 1032},    {32, 1024},
                                         {16, 1376}, {32, 3}, {32, 11},  {32, 1 << 16}, {256, 1 << 16}};

/// Attributes that decide about pixels, and the types they must have.
struct Known {
  std::string_view name, type;
};
constexpr Known kKnown[] = {{"channels", "chlist"},
                            {"chunkCount", "int"},
                            {"compression", "compression"},
                            {"dataWindow", "box2i"},
                            {"displayWindow", "box2i"},
                            {"lineOrder", "lineOrder"},
                            {"name", "string"},
                            {"pixelAspectRatio", "float"},
                            {"screenWindowCenter", "v2f"},
                            {"screenWindowWidth", "float"},
                            {"tiles", "tiledesc"},
                            {"type", "string"},
                            {"version", "int"}};

constexpr std::string_view kPartNames[] = {"chunkCount", "name", "type", "version"};

/// Reads little-endian values and strings one after another; never beyond the end.
class Reader {
 public:
  Reader(const fs::path& path, std::span<std::byte> bytes) : path_(path), bytes_(bytes) {}

  [[noreturn]] void fail(const std::string& what) const { failImage(path_, "is damaged or truncated: " + what); }
  size_t offset() const { return offset_; }
  size_t rest() const { return bytes_.size() - offset_; }

  std::span<std::byte> take(size_t count) {
    if (count > rest()) fail("its header ends too early");
    const auto taken = bytes_.subspan(offset_, count);
    offset_ += count;
    return taken;
  }
  uint8_t byte() { return std::to_integer<uint8_t>(take(1)[0]); }
  uint32_t word() {
    uint32_t value = 0;
    const auto bytes = take(4);
    for (size_t i = 0; i < 4; ++i) value |= std::to_integer<uint32_t>(bytes[i]) << (8 * i);
    return value;
  }
  int32_t integer() { return static_cast<int32_t>(word()); }
  /// Up to the next 0, which is passed.
  std::string_view name() {
    const auto* start = reinterpret_cast<const char*>(bytes_.data()) + offset_;
    const size_t length = ::strnlen(start, std::min<size_t>(rest(), 256));
    if (length == std::min<size_t>(rest(), 256)) fail("a name in its header has no end");
    offset_ += length + 1;
    return {start, length};
  }

 private:
  const fs::path& path_;
  std::span<std::byte> bytes_;
  size_t offset_ = 0;
};

struct Tiles {
  int64_t width, height;
  uint32_t levels;  ///< 0: one, 1: smaller and smaller, 2: so in each direction by itself.
  bool roundsUp;
};

/// What one header says.
struct Header {
  ExrPart part;
  std::optional<Tiles> tiles;
  uint8_t compression = 0;
  std::string type;
  std::set<std::string, std::less<>> seen;
};

ExrWindow takeWindow(Reader& reader) {
  const int64_t left = reader.integer(), top = reader.integer(), right = reader.integer(), bottom = reader.integer();
  return {left, top, right - left + 1, bottom - top + 1};
}

std::vector<ExrChannel> takeChannels(Reader& reader) {
  std::vector<ExrChannel> channels;
  for (auto name = reader.name(); !name.empty(); name = reader.name()) {
    ExrChannel channel{std::string(name)};
    channel.type = reader.word();
    if (channel.type > 2) reader.fail("channel '" + channel.name + "' has an unknown type");
    reader.take(4);
    const int32_t x = reader.integer(), y = reader.integer();
    channel.isSubsampled = x != 1 || y != 1;
    channels.push_back(std::move(channel));
    if (channels.size() > kMaxChannels) reader.fail("it has more than " + std::to_string(kMaxChannels) + " channels");
  }
  return channels;
}

void overwrite(Reader& value, std::initializer_list<float> floats) {
  for (const float number : floats) {
    const auto bits = std::bit_cast<uint32_t>(number);
    const auto bytes = value.take(4);
    for (size_t i = 0; i < 4; ++i) bytes[i] = static_cast<std::byte>(bits >> (8 * i));
  }
}

std::string textOf(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// An attribute of kKnown.
void takeValue(Header& header, std::string_view name, std::span<std::byte> bytes, Reader value) {
  if (name == "channels") {
    header.part.channels = takeChannels(value);
  } else if (name == "compression") {
    header.compression = value.byte();
    if (header.compression >= std::size(kCompressions)) value.fail("its compression is unknown");
  } else if (name == "dataWindow") {
    header.part.data = takeWindow(value);
  } else if (name == "displayWindow") {
    header.part.display = takeWindow(value);
  } else if (name == "lineOrder") {
    if (value.byte() > 2) value.fail("its line order is unknown");
  } else if (name == "name") {
    header.part.name = textOf(bytes);
  } else if (name == "type") {
    header.type = textOf(bytes);
  } else if (name == "tiles") {
    const int64_t width = value.word(), height = value.word();
    const uint8_t mode = value.byte();
    header.tiles = Tiles{width, height, mode & 0xfu, (mode >> 4) == 1};
    if ((mode & 0xf) > 2 || mode >> 4 > 1) value.fail("its tiles have an unknown mode");
  } else if (name == "screenWindowCenter") {
    overwrite(value, {0.0f, 0.0f});  // These three say nothing of the pixels, but odd values would be refused.
  } else if (name == "screenWindowWidth" || name == "pixelAspectRatio") {
    overwrite(value, {1.0f});
  }
}

/// One header up to its end. `hasTypes`: the file has several parts or deep ones, whose headers name and type them. False: it is empty, which ends the headers of a file of several parts.
bool takeHeader(const fs::path& path, std::span<std::byte> file, bool hasTypes, Reader& reader, Header& header) {
  for (auto name = reader.name(); !name.empty(); name = reader.name()) {
    const size_t typeOffset = reader.offset();
    const std::string_view type = reader.name();
    if (type.empty()) reader.fail("attribute '" + std::string(name) + "' has no type");
    const int32_t size = reader.integer();
    if (size < 0) reader.fail("attribute '" + std::string(name) + "' has a negative size");
    const auto bytes = reader.take(static_cast<size_t>(size));
    const auto* known = std::ranges::find(kKnown, name, &Known::name);
    // Names that mean something in such files are free in others.
    const bool isFree = !hasTypes && known != std::end(kKnown) && type != known->type &&
                        std::ranges::find(kPartNames, name) != std::end(kPartNames);
    if (known == std::end(kKnown) || isFree) {
      std::ranges::fill(file.subspan(typeOffset, type.size()), std::byte{'?'});
      continue;
    }
    if (type != known->type || !header.seen.emplace(name).second) {
      reader.fail("attribute '" + std::string(name) + "' is not as it should be");
    }
    takeValue(header, name, bytes, Reader(path, bytes));
  }
  return !header.seen.empty();
}

/// Tiles or groups of lines of a part, over all its levels.
int64_t chunksOf(const Header& header) {
  const auto& window = header.part.data;
  const auto parts = [](int64_t size, int64_t step) { return (size + step - 1) / step; };
  if (!header.tiles) return parts(window.height, kCompressions[header.compression].lines);
  const Tiles& tiles = *header.tiles;
  const auto levels = [&](int64_t size) {
    const int bits = std::bit_width(static_cast<uint64_t>(size));
    const bool isPower = std::has_single_bit(static_cast<uint64_t>(size));
    return tiles.roundsUp && !isPower ? bits + 1 : bits;
  };
  const auto sizeAt = [&](int64_t size, int level) {
    return std::max<int64_t>(1, tiles.roundsUp ? parts(size, int64_t{1} << level) : size >> level);
  };
  const auto tilesAt = [&](int levelX, int levelY) {
    return parts(sizeAt(window.width, levelX), tiles.width) * parts(sizeAt(window.height, levelY), tiles.height);
  };
  if (tiles.levels == 0) return tilesAt(0, 0);
  int64_t sum = 0;
  if (tiles.levels == 1) {
    for (int level = 0; level < levels(std::max(window.width, window.height)); ++level) sum += tilesAt(level, level);
    return sum;
  }
  for (int x = 0; x < levels(window.width); ++x) {
    for (int y = 0; y < levels(window.height); ++y) sum += tilesAt(x, y);
  }
  return sum;
}

void checkPart(const fs::path& path, const Reader& reader, const Header& header) {
  for (const auto* name : {"channels", "compression", "dataWindow", "displayWindow", "lineOrder", "pixelAspectRatio",
                           "screenWindowCenter", "screenWindowWidth"}) {
    if (!header.seen.contains(name)) reader.fail("attribute '" + std::string(name) + "' is missing");
  }
  const ExrPart& part = header.part;
  if (part.channels.empty()) failImage(path, "has no channels");
  requireReadableSize(path, part.data.width, part.data.height);
  requireReadableSize(path, part.display.width, part.display.height);
  if (!header.tiles) return;
  // A tile may be larger than a small picture.
  const int64_t most = std::max<int64_t>(4096, 2 * std::max(part.data.width, part.data.height));
  const auto fits = [&](int64_t side) { return side >= 1 && side <= most; };
  if (!fits(header.tiles->width) || !fits(header.tiles->height)) {
    reader.fail("its tiles are " + std::to_string(header.tiles->width) + "x" + std::to_string(header.tiles->height) +
                " px");
  }
}

uint64_t bytesPerPixel(const ExrPart& part) {
  constexpr std::array<uint64_t, 3> kBytes = {4, 2, 4};
  uint64_t sum = 0;
  for (const ExrChannel& channel : part.channels) sum += channel.isSubsampled ? 0 : kBytes[channel.type];
  return sum;
}

/// The library holds some tiles or groups of lines at once, with all their channels.
void checkChunk(const fs::path& path, const Header& header) {
  constexpr uint64_t kMostBytes = uint64_t{1} << 30;
  const int64_t lines = std::min(kCompressions[header.compression].lines, header.part.data.height);
  const int64_t pixels = header.tiles ? header.tiles->width * header.tiles->height : header.part.data.width * lines;
  if (static_cast<uint64_t>(pixels) * bytesPerPixel(header.part) <= kMostBytes) return;
  failImage(path, "has " + std::to_string(header.part.channels.size()) + " channels in pieces of " +
                      std::to_string(pixels) + " pixels, larger than the 2^30 bytes that are read at once");
}

/// What all parts claim against what stands behind the headers.
void checkSizes(const Reader& reader, const std::vector<Header>& headers) {
  constexpr uint64_t kBytesPerChunk = 8 + 8;  // its entry in the table of offsets; its own place and size
  uint64_t chunks = 0;
  double compressed = 0.0;
  for (const Header& header : headers) {
    const ExrPart& part = header.part;
    chunks += static_cast<uint64_t>(chunksOf(header));
    if (part.isDeep) continue;
    compressed += static_cast<double>(bytesPerPixel(part)) * static_cast<double>(part.data.width * part.data.height) /
                  static_cast<double>(kCompressions[header.compression].ratio);
  }
  if (chunks * kBytesPerChunk <= reader.rest() && compressed <= static_cast<double>(reader.rest())) return;
  const auto& window = headers.front().part.data;
  reader.fail(std::to_string(reader.rest()) + " bytes cannot hold the " + std::to_string(window.width) + "x" +
              std::to_string(window.height) + " pixels that it claims");
}

}  // namespace

std::vector<ExrPart> readExrHeaders(const fs::path& path, std::span<std::byte> file) {
  Reader reader(path, file);
  if (reader.rest() < 8 || reader.word() != kMagic) failImage(path, "is not an EXR file");
  const uint32_t version = reader.word();
  if ((version & 0xff) != 2 || (version & ~(0xffu | kTiled | kLongNames | kNonImage | kMultiPart)) != 0) {
    failImage(path, "is of an EXR version that is not read");
  }
  const bool isMultiPart = (version & kMultiPart) != 0;
  std::vector<Header> headers;
  for (Header header; takeHeader(path, file, (version & (kMultiPart | kNonImage)) != 0, reader, header); header = {}) {
    const bool isTyped = header.seen.contains("type") && (isMultiPart || (version & kNonImage) != 0);
    const std::string type = isTyped ? header.type : (version & kTiled) != 0 ? "tiledimage" : "scanlineimage";
    header.part.isDeep = type == "deepscanline" || type == "deeptile" || (!isMultiPart && (version & kNonImage) != 0);
    const bool isTiled = type == "tiledimage" || type == "deeptile";
    if (isTiled && !header.tiles) reader.fail("attribute 'tiles' is missing");
    if (!isTiled) header.tiles.reset();
    checkPart(path, reader, header);
    checkChunk(path, header);
    headers.push_back(std::move(header));
    if (!isMultiPart) break;
    if (headers.size() > kMaxParts) reader.fail("it has more than " + std::to_string(kMaxParts) + " parts");
  }
  if (headers.empty()) reader.fail("it has no header");
  checkSizes(reader, headers);
  std::vector<ExrPart> parts;
  for (Header& header : headers) parts.push_back(std::move(header.part));
  return parts;
}

}  // namespace lensgraph::engine
