// Names of shots, variants and files: see names.h.
#include "samples/lensgraph/bench/names.h"

#include <cctype>

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

}  // namespace lensgraph::cli
