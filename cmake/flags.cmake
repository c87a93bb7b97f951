# lensgraph_flags: what every target of the project is built with. Third-party headers are SYSTEM and exempt.
# Included by the project and by rendergraph/ when that is built by itself.
option(LENSGRAPH_WARNINGS_AS_ERRORS "Treat compiler warnings as errors" OFF)
option(LENSGRAPH_ASSERTIONS "Keep assert() in optimised builds" OFF)
set(LENSGRAPH_SANITIZE "" CACHE STRING "Sanitizers to build with, e.g. address,undefined")

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
if(LENSGRAPH_ASSERTIONS)
  string(REPLACE "-DNDEBUG" "" CMAKE_CXX_FLAGS_RELWITHDEBINFO "${CMAKE_CXX_FLAGS_RELWITHDEBINFO}")
endif()

add_library(lensgraph_flags INTERFACE)
# -Wno-missing-field-initializers: Vulkan's structs are filled from sType on, the rest zero; that is their idiom.
target_compile_options(lensgraph_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wno-missing-field-initializers -ffp-contract=off
  $<$<BOOL:${LENSGRAPH_WARNINGS_AS_ERRORS}>:-Werror>)
# GCC bug 105651, in GCC 12 alone: once std::string's operator+(const char*, std::string) is inlined, -Wrestrict reports
# an overlap that cannot be.
set(gcc_12 "$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_GREATER_EQUAL:$<CXX_COMPILER_VERSION>,12>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>")
target_compile_options(lensgraph_flags INTERFACE $<${gcc_12}:-Wno-restrict>)
# The same of lengths and offsets at -O3 (bug 105329).
target_compile_options(lensgraph_flags INTERFACE
  $<$<AND:${gcc_12},$<CONFIG:Release>>:-Wno-stringop-overflow>
  $<$<AND:${gcc_12},$<CONFIG:Release>>:-Wno-array-bounds>)
if(LENSGRAPH_SANITIZE)
  # What a sanitizer finds ends the program, so that a test cannot pass over it.
  target_compile_options(lensgraph_flags INTERFACE
    -fsanitize=${LENSGRAPH_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer
    $<${gcc_12}:-Wno-maybe-uninitialized>)  # Wrong in std::function where GCC 12 has added a sanitizer's code (bug 105562).
  target_link_options(lensgraph_flags INTERFACE -fsanitize=${LENSGRAPH_SANITIZE})
  if(LENSGRAPH_SANITIZE MATCHES "address|leak")
    target_sources(lensgraph_flags INTERFACE $<$<STREQUAL:$<TARGET_PROPERTY:TYPE>,EXECUTABLE>:${CMAKE_CURRENT_LIST_DIR}/../tests/support/sanitizer_setup.cpp>)
  endif()
endif()
