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

/// A folder of its own in the system's folder for temporary files, removed with everything in it afterwards.
class ScratchFolder {
 public:
  /// Throws engine::Error (failed) where none can be made.
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Runs `program arguments…` and waits. Throws engine::Error (failed) where it cannot be waited for.
ChildOutcome runChild(const std::filesystem::path& program, const std::vector<std::string>& arguments);

}  // namespace lensgraph::cli
