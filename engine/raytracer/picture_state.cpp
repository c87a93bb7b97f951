// The file: lines of text that say what it is (magic, identity, size, samples, an empty line), the pixels as they are in
// memory, and a hash of all before it. It is read by the same program on the same kind of machine only.
#include "engine/raytracer/picture_state.h"

#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <span>
#include <sstream>

#include "engine/error.h"
#include "engine/files/output_file.h"

namespace lensgraph::engine {
namespace {

constexpr const char* kMagic = "lensgraph ray-traced state 1";

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& reason) {
  throw Error({.file = file.string(),
               .field = "checkpoint",
               .reason = reason,
               .remedy = "remove the file to start anew, or name another"});
}

std::string header(const StateIdentity& identity, uint32_t samplesDone) {
  std::string text = std::string(kMagic) + "\n";
  for (const auto& [name, value] : identity) text += name + " = " + value + "\n";
  return text + "samples done = " + std::to_string(samplesDone) + "\n\n";
}

std::string hashOf(const std::string& bytes) {
  StateHash hash;
  hash.add(bytes.data(), bytes.size());
  return hash.hex();
}

/// The lines up to the empty one must be those of this identity; returns the samples done.
uint32_t readHeader(const std::filesystem::path& file, std::istringstream& stream, const StateIdentity& identity) {
  std::string line;
  for (const auto& [name, value] : identity) {
    std::getline(stream, line);
    const auto equals = line.find(" = ");
    if (equals == std::string::npos || line.substr(0, equals) != name) fail(file, "is of another version");
    const std::string known = line.substr(equals + 3);
    if (known != value) fail(file, "is of another " + name + " (" + known + ", now " + value + ")");
  }
  unsigned samples = 0;
  std::getline(stream, line);
  if (std::sscanf(line.c_str(), "samples done = %u", &samples) != 1) fail(file, "is damaged");
  std::getline(stream, line);
  return samples;
}

}  // namespace

FloatImage PictureState::picture() const {
  FloatImage image(width, height, 4, 1.0f);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const PixelSum& sum = pixels[i];
    float* pixel = image.samples.data() + i * 4;
    pixel[0] = static_cast<float>(sum.red / sum.weight);
    pixel[1] = static_cast<float>(sum.green / sum.weight);
    pixel[2] = static_cast<float>(sum.blue / sum.weight);
  }
  return image;
}

void saveState(const std::filesystem::path& file, const StateIdentity& identity, const PictureState& state) {
  std::string content = header(identity, state.samplesDone);
  content.append(reinterpret_cast<const char*>(state.pixels.data()), state.pixels.size() * sizeof(PixelSum));
  content += hashOf(content);
  writeFile(file, content);
}

PictureState loadState(const std::filesystem::path& file, const StateIdentity& identity, uint32_t width,
                       uint32_t height) {
  PictureState state{.width = width, .height = height, .samplesDone = 0, .pixels = {}};
  state.pixels.resize(std::size_t{width} * height);
  std::error_code code;
  const auto status = std::filesystem::status(file, code);
  if (!std::filesystem::exists(status)) return state;
  if (!std::filesystem::is_regular_file(status)) fail(file, "is no file");
  std::ifstream stream(file, std::ios::binary);
  const std::string content((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  if (!content.starts_with(std::string(kMagic) + "\n")) fail(file, "is no state of a ray-traced picture");
  const auto end = content.find("\n\n");
  if (end == std::string::npos) fail(file, "is damaged");
  std::istringstream lines(content.substr(std::strlen(kMagic) + 1, end + 2));
  state.samplesDone = readHeader(file, lines, identity);
  const std::size_t start = end + 2, bytes = state.pixels.size() * sizeof(PixelSum), hash = start + bytes;
  if (content.size() < hash || content.substr(hash) != hashOf(content.substr(0, hash))) fail(file, "is damaged");
  std::memcpy(state.pixels.data(), content.data() + start, bytes);
  return state;
}

void StateHash::add(const void* bytes, std::size_t size) {
  for (const std::byte byte : std::span(static_cast<const std::byte*>(bytes), size)) {
    value_ = (value_ ^ static_cast<uint64_t>(byte)) * 0x100000001b3u;
  }
}

std::string StateHash::hex() const {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(value_));
  return text;
}

}  // namespace lensgraph::engine
