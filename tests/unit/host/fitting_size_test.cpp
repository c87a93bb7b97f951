// The size that is suggested fits, and the next larger one does not.
#include "samples/host/limits/fitting_size.h"

#include <gtest/gtest.h>

namespace lensgraph::host {
namespace {

TEST(FittingSize, IsTheLargestOfItsShapeThatFits) {
  int asked = 0;
  const auto fitting = largestFitting({16384, 8192}, [&](PictureExtent extent) {
    ++asked;
    return static_cast<int64_t>(extent.width) * extent.height <= 2'000'000;
  });
  ASSERT_TRUE(fitting);
  EXPECT_EQ(fitting->width, 2000);
  EXPECT_EQ(fitting->height, 1000);
  EXPECT_LE(asked, 14);
}

TEST(FittingSize, IsNoneWhereNothingFits) {
  EXPECT_FALSE(largestFitting({640, 360}, [](PictureExtent) { return false; }));
}

TEST(FittingSize, KeepsAPixelOfWidth) {
  const auto fitting = largestFitting({1, 16384}, [](PictureExtent extent) { return extent.height <= 5; });
  ASSERT_TRUE(fitting);
  EXPECT_EQ(fitting->width, 1);
  EXPECT_EQ(fitting->height, 5);
}

}  // namespace
}  // namespace lensgraph::host
