// Names of shots, variants and files: see names.h.
#include "samples/lensgraph/bench/names.h"

#include <cctype>
#include <cstdint>
#include <cstdio>

#include "passes/parameters.h"

namespace lensgraph::cli {

std::string shotId(const std::filesystem::path& shot) {
  if (shot.stem() != "shot") return shot.stem().string();
  const auto folder = std::filesystem::absolute(shot).parent_path().filename();
  return folder.empty() ? shot.stem().string() : folder.string();
}

std::string variantId(const host::TechniqueChoice& choice) {
  std::string id = choice.name;
  for (const auto& [name, value] : choice.parameters) id += " " + name + "=" + passes::toString(value);
  return id;
}

std::string fileNameOf(std::string_view text) {
  std::string name(text);
  for (char& c : name) {
    const bool isPlain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '-' || c == '_';
    if (!isPlain) c = '_';
  }
  return name;
}

std::string hashOfText(std::string_view text) {
  uint64_t hash = 0xcbf29ce484222325u;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  char digits[17];
  std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(hash));
  return digits;
}

}  // namespace lensgraph::cli
