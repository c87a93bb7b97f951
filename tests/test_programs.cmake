# add_test_program(NAME label libraries...) builds every .cpp of the current folder and those below it into one program.
find_package(GTest REQUIRED)
include(GoogleTest)

function(add_test_program name label)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  add_executable(${name} ${sources})
  target_link_libraries(${name} PRIVATE ${ARGN} GTest::gmock GTest::gtest_main lensgraph_flags)
  get_filename_component(root ${CMAKE_CURRENT_FUNCTION_LIST_DIR} DIRECTORY)
  target_compile_definitions(${name} PRIVATE
    LENSGRAPH_SOURCE_DIR="${root}" LENSGRAPH_SHOTS_DIR="${LENSGRAPH_SHOTS}")
  set(environment)
  if(label STREQUAL "unit")
    # No driver is there for what must not need one.
    set(environment ENVIRONMENT "VK_ICD_FILENAMES=/nonexistent;VK_DRIVER_FILES=/nonexistent")
  endif()
  gtest_discover_tests(${name} DISCOVERY_MODE PRE_TEST PROPERTIES LABELS ${label} TIMEOUT 900 ${environment})
endfunction()
