// An error is one line, whatever is put into it.
#include "engine/error.h"

#include <gtest/gtest.h>

namespace lensgraph {

namespace {

TEST(Error, JoinsItsPartsInOneLine) {
  const engine::Error error({.file = "a.gltf", .field = "meshes[2]", .reason = "is wrong", .remedy = "mend it"});
  EXPECT_STREQ(error.what(), "a.gltf: meshes[2]: is wrong; mend it");
  EXPECT_EQ(error.kind(), engine::ErrorKind::badInput);
}

TEST(Error, LeavesOutEmptyParts) {
  EXPECT_STREQ(engine::Error("is wrong").what(), "is wrong");
}

TEST(Error, NeverSpansTwoLines) {
  const engine::Error error({.file = "a\nb.png", .field = {}, .reason = "first\r\nsecond\n", .remedy = {}});
  EXPECT_EQ(std::string(error.what()).find_first_of("\r\n"), std::string::npos);
}

}  // namespace

}  // namespace lensgraph
