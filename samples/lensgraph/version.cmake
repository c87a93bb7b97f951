# Writes version.h. Run at build time with -DSOURCE, -DVERSION, -DOUTPUT; the commit is empty outside a git checkout.
set(COMMIT "")
find_program(GIT git)
if(GIT AND EXISTS ${SOURCE}/.git)
  execute_process(COMMAND ${GIT} -C ${SOURCE} describe --always --dirty --abbrev=12 --exclude=*
    OUTPUT_VARIABLE COMMIT OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
file(CONFIGURE OUTPUT ${OUTPUT} @ONLY CONTENT [[
// Written by version.cmake.
#pragma once

namespace lensgraph::cli {
inline constexpr const char* kVersion = "@VERSION@";
/// Abbreviated, with "-dirty" when the tree had changes; empty when built outside a git checkout.
inline constexpr const char* kCommit = "@COMMIT@";
}  // namespace lensgraph::cli
]])
