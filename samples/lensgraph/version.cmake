# Writes version.cpp. Run at build time with -DSOURCE, -DVERSION, -DOUTPUT; the commit is empty outside a git checkout.
set(COMMIT "")
find_program(GIT git)
if(GIT AND EXISTS ${SOURCE}/.git)
  execute_process(COMMAND ${GIT} -C ${SOURCE} describe --always --dirty --abbrev=12 --exclude=*
    OUTPUT_VARIABLE COMMIT OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
file(CONFIGURE OUTPUT ${OUTPUT} @ONLY CONTENT [[
// Written by version.cmake.
#include "samples/lensgraph/version.h"

namespace lensgraph::cli {
const char* const kVersion = "@VERSION@";
const char* const kCommit = "@COMMIT@";
}  // namespace lensgraph::cli
]])
