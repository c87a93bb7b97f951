#include "rendergraph/handle.h"

#include <gtest/gtest.h>

namespace lensgraph {

TEST(Handle, DefaultIsNoResource) {
  EXPECT_FALSE(rendergraph::Image{});
}

}  // namespace lensgraph
