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

/// Runs `program arguments…` and waits. Its output goes through two files in `folder`, which are removed. Throws
/// engine::Error (failed) where no process or file can be made.
ChildOutcome runChild(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                      const std::filesystem::path& folder);

}  // namespace lensgraph::cli
