# Builds rendergraph, shaders and passes by the preset release, in -DBUILD, and runs the unit tests of passes there.
execute_process(COMMAND ${CMAKE_COMMAND} --preset release -B ${BUILD} ${OPTIONS}
  -DLENSGRAPH_BUILD_ENGINE=OFF "-DLENSGRAPH_TEST_ROOMS=support;unit/passes"
  WORKING_DIRECTORY ${SOURCE} COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} --build ${BUILD} --target passes_unit_tests COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${BUILD}/tests/unit/passes/passes_unit_tests --gtest_brief=1 COMMAND_ERROR_IS_FATAL ANY)
