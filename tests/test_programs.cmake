# add_test_program(NAME label libraries...) builds every .cpp of the current folder and those below it into one program,
# of which every test is one of CTest's. add_test_executable(NAME libraries...) leaves CTest to its caller.
find_package(GTest REQUIRED)
include(GoogleTest)

# GoogleTest's headers, parsed once; CMAKE_DISABLE_PRECOMPILE_HEADERS=ON leaves that to every file.
file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/generated/test_headers.cpp
  CONTENT "// A target with precompiled headers must have a source.\n")
add_library(lensgraph_test_headers OBJECT ${CMAKE_BINARY_DIR}/generated/test_headers.cpp)
target_link_libraries(lensgraph_test_headers PRIVATE GTest::gmock lensgraph_flags)
target_precompile_headers(lensgraph_test_headers PRIVATE <algorithm> <functional> <gmock/gmock.h> <gtest/gtest.h>)

function(add_test_executable name)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  add_executable(${name} ${sources})
  target_link_libraries(${name} PRIVATE ${ARGN} GTest::gmock GTest::gtest_main lensgraph_flags)
  target_precompile_headers(${name} REUSE_FROM lensgraph_test_headers)
  get_filename_component(root ${CMAKE_CURRENT_FUNCTION_LIST_DIR} DIRECTORY)
  target_compile_definitions(${name} PRIVATE
    LENSGRAPH_SOURCE_DIR="${root}" LENSGRAPH_SHOTS_DIR="${LENSGRAPH_SHOTS}")
endfunction()

function(add_test_program name label)
  add_test_executable(${name} ${ARGN})
  set(environment)
  if(label STREQUAL "unit")
    # No driver is there for what must not need one.
    set(environment ENVIRONMENT "VK_ICD_FILENAMES=/nonexistent;VK_DRIVER_FILES=/nonexistent")
  endif()
  gtest_discover_tests(${name} DISCOVERY_MODE PRE_TEST PROPERTIES LABELS ${label} TIMEOUT 900 ${environment})
endfunction()
