// Errors that name the glTF file.
#include "engine/gltf/read/source.h"

#include "engine/error.h"

namespace lensgraph::engine::gltf {

void Source::fail(const std::string& field, const std::string& reason, const std::string& remedy) const {
  throw Error(ErrorParts{.file = file, .field = field, .reason = reason, .remedy = remedy});
}

std::string at(const char* array, size_t index, const std::string& member) {
  return std::string(array) + "[" + std::to_string(index) + "]" + member;
}

}  // namespace lensgraph::engine::gltf
