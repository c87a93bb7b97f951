// Reads PNG files with libpng: see picture_file.h.
//
// Only what decides about pixels is read: IHDR, PLTE, tRNS, IDAT, and gAMA and sRGB, which tell linear files apart. libpng
// skips the rest unread, whatever it holds, and says nothing by itself.
#include <png.h>

#include <array>
#include <csetjmp>
#include <cstdint>
#include <cstring>
#include <new>
#include <string>
#include <string_view>

#include "engine/image/image_format.h"
#include "engine/image/picture_file.h"

namespace lensgraph::engine {
namespace {

namespace fs = std::filesystem;

/// What libpng's callbacks work on.
struct Stream {
  std::span<const std::byte> rest;
  std::array<char, 128> error{};  ///< No string: a longjmp passes it by.
};

void takeBytes(png_structp png, png_bytep target, size_t count) {
  auto& stream = *static_cast<Stream*>(png_get_io_ptr(png));
  if (count > stream.rest.size()) png_error(png, "it ends too early");
  std::memcpy(target, stream.rest.data(), count);
  stream.rest = stream.rest.subspan(count);
}

[[noreturn]] void noteError(png_structp png, png_const_charp message) {
  auto& stream = *static_cast<Stream*>(png_get_error_ptr(png));
  std::strncpy(stream.error.data(), message, stream.error.size() - 1);
  png_longjmp(png, 1);
}

void ignoreWarning(png_structp, png_const_charp) {}

/// libpng's two objects.
struct Decoder {
  Stream stream;
  png_structp png = nullptr;
  png_infop info = nullptr;

  explicit Decoder(std::span<const std::byte> bytes) : stream{bytes} {
    png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &stream, noteError, ignoreWarning);
    if (png != nullptr) info = png_create_info_struct(png);
    if (info == nullptr) throw std::bad_alloc();
    png_set_read_fn(png, &stream, takeBytes);
  }
  ~Decoder() { png_destroy_read_struct(&png, &info, nullptr); }
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;
};

/// Everything before the pixels. False: stream.error says why. Objects with destructors must not live here.
bool readHead(Decoder& decoder) {
  if (setjmp(png_jmpbuf(decoder.png)) != 0) return false;
  png_set_user_limits(decoder.png, kMaxSide, kMaxSide);
  png_set_keep_unknown_chunks(decoder.png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);  // all that libpng does not know
  static constexpr png_byte kUnused[] =
      "bKGD\0cHRM\0eXIf\0hIST\0iCCP\0iTXt\0oFFs\0pCAL\0pHYs\0sBIT\0sCAL\0sPLT\0sTER\0tEXt\0tIME\0zTXt";
  png_set_keep_unknown_chunks(decoder.png, PNG_HANDLE_CHUNK_NEVER, kUnused, sizeof kUnused / 5);
  png_set_crc_action(decoder.png, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT);
  png_set_benign_errors(decoder.png, 1);
  png_read_info(decoder.png, decoder.info);
  return true;
}

/// Chooses how pixels are given: 8 or 16 bits, big-endian, no palette, transparency as alpha; returns bytes a row.
bool chooseLayout(Decoder& decoder, size_t& bytesPerRow) {
  if (setjmp(png_jmpbuf(decoder.png)) != 0) return false;
  png_set_expand(decoder.png);
  png_set_interlace_handling(decoder.png);
  png_read_update_info(decoder.png, decoder.info);
  bytesPerRow = png_get_rowbytes(decoder.png, decoder.info);
  return true;
}

bool readRows(Decoder& decoder, png_bytepp rows) {
  if (setjmp(png_jmpbuf(decoder.png)) != 0) return false;
  png_read_image(decoder.png, rows);
  png_read_end(decoder.png, nullptr);
  return true;
}

uint32_t bigEndian(std::span<const std::byte> bytes) {
  uint32_t value = 0;
  for (size_t i = 0; i < 4; ++i) value = value << 8 | std::to_integer<uint32_t>(bytes[i]);
  return value;
}

/// Bytes of all IDAT chunks. Throws unless the chunks begin with a whole header and lead to an end within the file.
uint64_t compressedBytes(const fs::path& path, std::span<const std::byte> bytes) {
  constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n";
  const auto text = [&](size_t offset, size_t count) {
    return std::string_view(reinterpret_cast<const char*>(bytes.data()) + offset, count);
  };
  if (bytes.size() < 8 || text(0, 8) != kSignature) failImage(path, "is not a PNG file");
  constexpr size_t kHeaderEnd = 8 + 12 + 13;
  if (bytes.size() < kHeaderEnd || bigEndian(bytes.subspan(8)) != 13 || text(12, 4) != "IHDR") {
    failImage(path, "is damaged or truncated: it has no header");
  }
  uint64_t sum = 0;
  for (size_t offset = 8; bytes.size() - offset >= 12;) {
    const size_t length = bigEndian(bytes.subspan(offset));
    const auto type = text(offset + 4, 4);
    if (length > bytes.size() - offset - 12) break;
    if (type == "IDAT") sum += length;
    if (type == "IEND") return sum;
    offset += 12 + length;  // length, type, data, checksum
  }
  failImage(path, "is damaged or truncated");
}

class PngFile : public PictureFile {
 public:
  PngFile(const fs::path& path, std::vector<std::byte> bytes)
      : path_(path), bytes_(std::move(bytes)), compressed_(compressedBytes(path, bytes_)), decoder_(bytes_) {
    const auto head = std::span<const std::byte>(bytes_).subspan(16);
    requireReadableSize(path_, bigEndian(head), bigEndian(head.subspan(4)));  // libpng would call it invalid
    if (!readHead(decoder_)) fail();
    width_ = png_get_image_width(decoder_.png, decoder_.info);
    height_ = png_get_image_height(decoder_.png, decoder_.info);
    requireEnoughBytes();
    isPaletted_ = png_get_color_type(decoder_.png, decoder_.info) == PNG_COLOR_TYPE_PALETTE;
    storedBits_ = png_get_bit_depth(decoder_.png, decoder_.info);
    isEncoded_ = !isLinear();
    if (!chooseLayout(decoder_, bytesPerRow_)) fail();
    bits_ = png_get_bit_depth(decoder_.png, decoder_.info);
    largestInteger_ = bits_ == 16 ? 65535 : 255;
    constexpr std::array<const char*, 5> kNames = {"", "Y", "YA", "RGB", "RGBA"};
    PicturePart part;
    for (const char* c = kNames.at(png_get_channels(decoder_.png, decoder_.info)); *c != '\0'; ++c) {
      part.channels.emplace_back(1, *c);
    }
    parts_ = {part};
  }

  void requireWholeSamples() const override {
    if (isPaletted_) failImage(path_, "has a palette, so its values are no depths", "store it as grey");
    if (storedBits_ < 8) {
      failImage(path_, "has " + std::to_string(storedBits_) + " bits a sample, too few for depth", "store 8 or 16");
    }
  }

  FloatImage read(size_t, std::span<const size_t> channels, float) override {
    if (samples_.empty()) decode();
    FloatImage image(width_, height_, static_cast<uint32_t>(channels.size()));
    const size_t all = parts_.front().channels.size();
    for (size_t i = 0; i < image.pixelCount(); ++i) {
      for (size_t c = 0; c < channels.size(); ++c) {
        image.samples[i * channels.size() + c] = sample(i * all + channels[c]);
      }
    }
    return image;
  }

 private:
  [[noreturn]] void fail() const {
    failImage(path_, "is damaged or truncated: " + std::string(decoder_.stream.error.data()));
  }

  /// No deflate stream gives more than 1032 times its size. What is missing shows before memory is taken for it.
  void requireEnoughBytes() const {
    const uint64_t bitsPerPixel =
        uint64_t{png_get_channels(decoder_.png, decoder_.info)} * png_get_bit_depth(decoder_.png, decoder_.info);
    const uint64_t needed = bitsPerPixel * width_ / 8 * height_;
    if (needed / 1032 > compressed_) {
      failImage(path_, "is damaged or truncated: " + std::to_string(bytes_.size()) + " bytes cannot hold " +
                           std::to_string(width_) + "x" + std::to_string(height_) + " pixels");
    }
  }

  bool isLinear() {
    double gamma = 0.0;
    if (png_get_valid(decoder_.png, decoder_.info, PNG_INFO_sRGB) != 0) return false;
    return png_get_gAMA(decoder_.png, decoder_.info, &gamma) != 0 && gamma > 0.99 && gamma < 1.01;
  }

  void decode() {
    samples_.resize(bytesPerRow_ * height_);
    std::vector<png_bytep> rows(height_);
    for (size_t y = 0; y < rows.size(); ++y) rows[y] = samples_.data() + y * bytesPerRow_;
    if (!readRows(decoder_, rows.data())) fail();
  }

  float sample(size_t index) const {
    if (bits_ == 8) return samples_[index];
    return static_cast<float>(samples_[2 * index] << 8 | samples_[2 * index + 1]);
  }

  fs::path path_;
  std::vector<std::byte> bytes_;
  uint64_t compressed_;
  Decoder decoder_;
  uint32_t width_ = 0, height_ = 0;
  size_t bytesPerRow_ = 0;
  int bits_ = 0, storedBits_ = 0;
  bool isPaletted_ = false;
  std::vector<png_byte> samples_;
};

}  // namespace

std::unique_ptr<PictureFile> openPng(const fs::path& path, std::vector<std::byte> bytes) {
  return std::make_unique<PngFile>(path, std::move(bytes));
}

}  // namespace lensgraph::engine
