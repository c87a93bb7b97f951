// Which version of the program this is. Defined in a file that every build writes anew when the commit has changed, so
// that nothing else need be compiled then.
#pragma once

namespace lensgraph::cli {

extern const char* const kVersion;
/// Abbreviated, with "-dirty" when the tree had changes; empty when built outside a git checkout.
extern const char* const kCommit;

}  // namespace lensgraph::cli
