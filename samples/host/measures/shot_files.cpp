// Follows the references of glTF files: see shot_files.h.
#include "samples/host/measures/shot_files.h"

#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string_view>

namespace lensgraph::host {
namespace {

using std::filesystem::path;

constexpr uint64_t kFnvStart = 0xcbf29ce484222325u, kFnvFactor = 0x100000001b3u;

std::string digitsOf(uint64_t hash) {
  char digits[17];
  std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(hash));
  return digits;
}

/// "a%20b" as "a b".
std::string decoded(const std::string& uri) {
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    unsigned code = 0;
    if (uri[i] == '%' && std::sscanf(uri.c_str() + i + 1, "%2x", &code) == 1) {
      text += static_cast<char>(code);
      i += 2;
    } else {
      text += uri[i];
    }
  }
  return text;
}

/// Files that a .gltf names beside itself.
void addReferences(const path& gltf, std::vector<path>& files) {
  std::ifstream stream(gltf, std::ios::binary);
  const auto document = nlohmann::json::parse(stream, nullptr, false);
  if (!document.is_object()) return;
  for (const char* list : {"buffers", "images"}) {
    if (!document.contains(list) || !document[list].is_array()) continue;
    for (const auto& entry : document[list]) {
      if (!entry.is_object() || !entry.contains("uri") || !entry["uri"].is_string()) continue;
      const std::string uri = entry["uri"];
      if (!uri.starts_with("data:")) files.push_back(gltf.parent_path() / decoded(uri));
    }
  }
}

}  // namespace

std::vector<path> filesOf(const Shot& shot) {
  std::vector<path> files = {shot.file};
  for (const auto& part : shot.scene) {
    files.push_back(part.path);
    if (part.path.extension() == ".gltf") addReferences(part.path, files);
  }
  if (shot.environment) files.push_back(*shot.environment);
  return files;
}

std::string hashOfFiles(const std::vector<path>& files) {
  uint64_t hash = kFnvStart;
  for (const auto& file : files) {
    std::ifstream stream(file, std::ios::binary);
    for (auto byte = std::istreambuf_iterator<char>(stream); byte != std::istreambuf_iterator<char>{}; ++byte) {
      hash = (hash ^ static_cast<unsigned char>(*byte)) * kFnvFactor;
    }
  }
  return digitsOf(hash);
}

std::string hashOfText(std::string_view text) {
  uint64_t hash = kFnvStart;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * kFnvFactor;
  return digitsOf(hash);
}

}  // namespace lensgraph::host
