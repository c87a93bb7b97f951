// Runs another program to its end and keeps what it said and used.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lensgraph::cli {

struct ChildOutcome {
  int status = -1;       ///< Exit status; 128 + signal when it was ended by one; 127 when it could not be started.
  std::string out, err;  ///< What it wrote to stdout and stderr.
  double cpuMs = 0.0;    ///< User and system time of all its threads.
};

/// DIR/scratch, empty at first and removed with everything in it afterwards. What a killed process left there is removed by
/// the next.
class ScratchFolder {
 public:
  /// Throws engine::Error (failed) where it cannot be made.
  explicit ScratchFolder(const std::filesystem::path& folder);
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Runs `program arguments…` and waits. A signal that ends this process ends the child too. Throws engine::Error (failed)
/// where there is no memory for its output, or it cannot be waited for.
ChildOutcome runChild(const std::filesystem::path& program, const std::vector<std::string>& arguments);

}  // namespace lensgraph::cli
