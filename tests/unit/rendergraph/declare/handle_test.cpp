#include "rendergraph/handle.h"

#include <gtest/gtest.h>

TEST(Handle, DefaultIsNoResource) {
  EXPECT_FALSE(rendergraph::Image{});
}
