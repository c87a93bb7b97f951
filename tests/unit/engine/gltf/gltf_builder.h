// Writes small glTF files for tests: JSON that a test may bend as it likes, beside a growing binary buffer.
#pragma once

#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace lensgraph::test {

using Json = nlohmann::json;

inline std::string base64(std::span<const uint8_t> bytes) {
  static const char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (size_t i = 0; i < bytes.size(); i += 3) {
    uint32_t bits = uint32_t{bytes[i]} << 16;
    if (i + 1 < bytes.size()) bits |= uint32_t{bytes[i + 1]} << 8;
    if (i + 2 < bytes.size()) bits |= bytes[i + 2];
    for (int k = 0; k < 4; ++k)
      text += i + static_cast<size_t>(k) <= bytes.size() ? kDigits[bits >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

class GltfBuilder {
 public:
  Json json = {{"asset", {{"version", "2.0"}}}, {"scene", 0}, {"scenes", {{{"nodes", Json::array()}}}}};
  std::vector<uint8_t> binary;

  int addView(std::span<const uint8_t> bytes, int byteStride = 0) {
    while (binary.size() % 4 != 0) binary.push_back(0);
    Json view = {{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", bytes.size()}};
    if (byteStride != 0) view["byteStride"] = byteStride;
    binary.insert(binary.end(), bytes.begin(), bytes.end());
    return add("bufferViews", view);
  }

  template <typename T>
  int addView(const std::vector<T>& values, int byteStride = 0) {
    return addView(std::span(reinterpret_cast<const uint8_t*>(values.data()), values.size() * sizeof(T)), byteStride);
  }

  /// `type` is SCALAR, VEC3…; values are flat.
  template <typename T>
  int addAccessor(const std::vector<T>& values, const std::string& type, bool isNormalized = false) {
    const size_t components = type == "SCALAR" ? 1 : type == "MAT4" ? 16 : static_cast<size_t>(type[3] - '0');
    Json accessor = {{"bufferView", addView(values)},
                     {"componentType", componentType<T>()},
                     {"count", values.size() / components},
                     {"type", type}};
    if (isNormalized) accessor["normalized"] = true;
    return add("accessors", accessor);
  }

  /// A mesh of one primitive, and a node of the scene that places it. Returns the node.
  int addMesh(const Json& primitive) {
    const int mesh = add("meshes", {{"primitives", {primitive}}});
    return addNode({{"mesh", mesh}});
  }

  int addNode(const Json& node) {
    const int index = add("nodes", node);
    json["scenes"][0]["nodes"].push_back(index);
    return index;
  }

  int add(const char* array, const Json& element) {
    json[array].push_back(element);
    return static_cast<int>(json[array].size()) - 1;
  }

  /// A .gltf with its buffer as a data URI.
  std::filesystem::path write(const TemporaryFolder& folder, const std::string& name = "test.gltf") {
    if (!binary.empty() && !json.contains("buffers")) {
      json["buffers"] = {
          {{"byteLength", binary.size()}, {"uri", "data:application/octet-stream;base64," + base64(binary)}}};
    }
    std::ofstream(folder / name) << json.dump();
    return folder / name;
  }

  /// The bytes of a .glb.
  std::vector<uint8_t> glb() {
    while (binary.size() % 4 != 0) binary.push_back(0);
    if (!json.contains("buffers") && !binary.empty()) json["buffers"] = {{{"byteLength", binary.size()}}};
    std::string text = json.dump();
    while (text.size() % 4 != 0) text += ' ';
    std::vector<uint8_t> bytes = {'g', 'l', 'T', 'F'};
    append(bytes, 2);
    append(bytes, static_cast<uint32_t>(12 + 8 + text.size() + (binary.empty() ? 0 : 8 + binary.size())));
    append(bytes, static_cast<uint32_t>(text.size()));
    append(bytes, 0x4E4F534A);
    bytes.insert(bytes.end(), text.begin(), text.end());
    if (binary.empty()) return bytes;
    append(bytes, static_cast<uint32_t>(binary.size()));
    append(bytes, 0x004E4942);
    bytes.insert(bytes.end(), binary.begin(), binary.end());
    return bytes;
  }

 private:
  template <typename T>
  static int componentType() {
    if constexpr (std::is_same_v<T, float>) return 5126;
    if constexpr (std::is_same_v<T, uint32_t>) return 5125;
    if constexpr (std::is_same_v<T, uint16_t>) return 5123;
    if constexpr (std::is_same_v<T, int16_t>) return 5122;
    if constexpr (std::is_same_v<T, uint8_t>) return 5121;
    if constexpr (std::is_same_v<T, int8_t>) return 5120;
  }

  static void append(std::vector<uint8_t>& bytes, uint32_t value) {
    for (int k = 0; k < 4; ++k) bytes.push_back(static_cast<uint8_t>(value >> (8 * k)));
  }
};

/// Positions of the triangle (0,0,0) (1,0,0) (0,1,0).
inline const std::vector<float> kTriangle = {0, 0, 0, 1, 0, 0, 0, 1, 0};

/// A file with that triangle, drawn once by node 0, accessor 0, not indexed.
inline GltfBuilder triangleFile() {
  GltfBuilder builder;
  builder.addMesh({{"attributes", {{"POSITION", builder.addAccessor(kTriangle, "VEC3")}}}});
  return builder;
}

}  // namespace lensgraph::test
