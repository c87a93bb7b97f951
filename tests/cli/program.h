// Runs the built program and keeps what it said; and a folder with a small scene to run it on.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace lensgraph::cli_test {

struct Outcome {
  int status = -1;  ///< Exit status; 128 + signal when it was killed.
  std::string out, err;
};

/// Runs `lensgraph arguments…` in `folder`, its stdout and stderr going to files (so: no terminal). `prepare` is called
/// in the new process before the program takes its place; false makes the status 126.
Outcome run(const std::filesystem::path& folder, const std::vector<std::string>& arguments,
            const std::function<bool()>& prepare = {});

std::string contentOf(const std::filesystem::path& file);

/// A quad that faces the camera, and what may be wrong with it.
struct QuadOptions {
  float depth = 2.0f;      ///< m in front of the camera at the origin.
  float firstX = -1.0f;    ///< x of the first corner; NaN for a broken file.
  unsigned lastIndex = 3;  ///< 4 and above is out of range.
  bool textured = false;   ///< By the file texture.png, which is the test's to write.
};

class ProgramTest : public testing::Test {
 protected:
  ProgramTest();
  ~ProgramTest() override;

  const std::filesystem::path& folder() const { return folder_; }
  std::filesystem::path write(const std::string& name, const std::string& bytes) const;
  /// quad.gltf with quad.bin.
  void writeQuad(const QuadOptions& options = {}) const;
  /// quad.glb, its last `missingBytes` cut off.
  void writeQuadGlb(std::size_t missingBytes) const;
  /// A shot of the quad, 32×24 px, out of focus.
  nlohmann::json shot() const;
  void writeShot(const nlohmann::json& shot) const { write("shot.json", shot.dump(1)); }

  Outcome run(const std::vector<std::string>& arguments, const std::function<bool()>& prepare = {}) const {
    return cli_test::run(folder_, arguments, prepare);
  }
  /// Status 0 and nothing on stderr; returns stdout.
  std::string runWell(const std::vector<std::string>& arguments) const;
  /// That status, one line on stderr that holds every part, nothing on stdout, and no file more than before.
  void expectError(const std::vector<std::string>& arguments, int status, const std::vector<std::string>& parts) const;

 private:
  std::filesystem::path folder_, logs_;
};

}  // namespace lensgraph::cli_test
