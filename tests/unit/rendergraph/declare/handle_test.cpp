// Handles are values: comparing, versions, and what a default-made one says of itself.
#include "rendergraph/handle.h"

#include <gtest/gtest.h>

namespace lensgraph {

TEST(Handle, DefaultIsNoResource) {
  EXPECT_FALSE(rendergraph::Image{});
}

}  // namespace lensgraph
