// What the tests of picture files share: the line of an error, and the pictures of ../shared/cases.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "engine/error.h"

namespace lensgraph::test {

/// The message of the engine::Error that an action throws, which must be one line; "no error" when it throws none.
template <typename Action>
std::string errorOf(Action action) {
  try {
    action();
  } catch (const engine::Error& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    return error.what();
  }
  return "no error";
}

/// A picture that failed once; tests skip where the folder is absent.
inline std::filesystem::path casePicture(const std::string& name) {
  return std::filesystem::path(LENSGRAPH_SHOTS_DIR).parent_path() / "cases/pictures" / name;
}

}  // namespace lensgraph::test
