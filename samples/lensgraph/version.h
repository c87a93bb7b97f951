// Which version of the program this is. Defined in a file that every build writes anew when the commit has changed, so
// that nothing else need be compiled then.
#pragma once

#include <string>

namespace lensgraph::cli {

extern const char* const kVersion;
/// Abbreviated, with "-dirty" when the tree had changes; empty when built outside a git checkout.
extern const char* const kCommit;

/// "lensgraph 0.1.0 (COMMIT)", as --version says it.
inline std::string programName() {
  const std::string commit = kCommit;
  return std::string("lensgraph ") + kVersion + (commit.empty() ? "" : " (" + commit + ")");
}

}  // namespace lensgraph::cli
