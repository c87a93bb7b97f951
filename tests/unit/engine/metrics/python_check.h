// A second implementation in Python, run on pictures of a test.
#pragma once

#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "engine/image/image.h"
#include "tests/support/temporary_folder.h"

namespace lensgraph {

/// Runs a script of this folder with these lines on its standard input; returns what it prints. Nothing when Python, or a
/// package that the script needs, is absent; the script then exits with 77. Throws std::runtime_error when it fails.
inline std::optional<std::string> runPython(const std::string& script, const std::vector<std::string>& lines) {
  const test::TemporaryFolder folder;
  {
    std::ofstream input(folder / "input");
    for (const std::string& line : lines) input << line << "\n";
  }
  std::ostringstream command;
  command << LENSGRAPH_PYTHON " '" LENSGRAPH_SOURCE_DIR "/tests/unit/engine/metrics/" << script << "' < '"
          << (folder / "input").string() << "' > '" << (folder / "output").string() << "'";
  const int status = std::system(command.str().c_str());
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  if (code == 77 || code == 127) return std::nullopt;
  if (code != 0) throw std::runtime_error(script + " failed");
  std::ifstream output(folder / "output");
  return std::string(std::istreambuf_iterator<char>(output), {});
}

/// What a test says when it skips.
inline constexpr const char* kNoPython = "needs python3-numpy and python3-skimage";

/// The samples as a file of floats.
inline void writeFloats(const std::filesystem::path& file, const engine::FloatImage& image) {
  std::ofstream stream(file, std::ios::binary);
  stream.write(reinterpret_cast<const char*>(image.samples.data()),
               static_cast<std::streamsize>(image.samples.size() * sizeof(float)));
}

inline std::vector<float> readFloats(const std::filesystem::path& file, size_t count) {
  std::vector<float> values(count);
  std::ifstream stream(file, std::ios::binary);
  stream.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(count * sizeof(float)));
  if (!stream) throw std::runtime_error(file.string() + " is too short");
  return values;
}

}  // namespace lensgraph
