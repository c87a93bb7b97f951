// Loads a glTF file that a test has built, and gives what came of it: a scene, warnings, or an error's line.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "engine/error.h"
#include "engine/gltf/load_gltf.h"
#include "gltf_builder.h"

namespace lensgraph::test {

struct Loaded {
  engine::Scene scene;
  std::vector<std::string> warnings;  ///< Without the file's name.
  std::string error;                  ///< Likewise; empty when the file was read.
};

inline Loaded loadFile(const std::filesystem::path& path, const engine::GltfOptions& options = {}) {
  Loaded result;
  const std::string start = path.string() + ": ";
  const auto withoutFile = [&](const std::string& line) {
    EXPECT_TRUE(line.starts_with(start)) << line;
    EXPECT_LE(line.size(), engine::kLongestLine);
    return line.substr(std::min(start.size(), line.size()));
  };
  try {
    for (const std::string& line : engine::appendGltf(result.scene, path, glm::dmat4(1.0), options))
      result.warnings.push_back(withoutFile(line));
    for (const std::string& problem : engine::findProblems(result.scene)) ADD_FAILURE() << problem;
  } catch (const engine::Error& error) {
    result.error = withoutFile(error.what());
  }
  return result;
}

inline Loaded load(GltfBuilder& builder, const engine::GltfOptions& options = {}) {
  const TemporaryFolder folder;
  return loadFile(builder.write(folder), options);
}

/// Corners of a primitive in drawing order.
inline std::vector<glm::vec3> cornersOf(const engine::Primitive& primitive) {
  std::vector<glm::vec3> result;
  for (uint32_t index : primitive.indices) result.push_back(primitive.positions[index]);
  return result;
}

}  // namespace lensgraph::test
