// What object matrices do to the winding of triangles.
#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "engine/draw/scene_gpu.h"

namespace lensgraph {

namespace {

using engine::Winding;
using engine::windingOf;

glm::dmat4 turned(const glm::dvec3& scale) {
  return glm::scale(glm::rotate(glm::dmat4(1.0), 0.7, glm::dvec3(1, 2, -3)), scale);
}

TEST(WindingOfMatrices, IsTurnedByAnOddNumberOfMirrors) {
  EXPECT_EQ(windingOf(glm::dmat4(1.0)), Winding::kept);
  EXPECT_EQ(windingOf(turned({2, 3, 4})), Winding::kept);
  EXPECT_EQ(windingOf(turned({-2, -3, 4})), Winding::kept);
  EXPECT_EQ(windingOf(turned({2, -3, 4})), Winding::turned);
  EXPECT_EQ(windingOf(turned({-2, -3, -4})), Winding::turned);
}

TEST(WindingOfMatrices, IsLostInAPlaneButNotInAThinOrTinyOrHugeObject) {
  EXPECT_EQ(windingOf(turned({2, 3, 0})), Winding::lost);
  EXPECT_EQ(windingOf(turned({0, 0, 1})), Winding::lost);
  glm::dmat4 parallelAxes = turned({1, 1, 1});
  parallelAxes[2] = parallelAxes[0] * 0.3 - parallelAxes[1] * 1.7;
  EXPECT_EQ(windingOf(parallelAxes), Winding::lost);
  for (const double size : {1e-200, 1e-6, 1e6, 1e200}) {
    EXPECT_EQ(windingOf(turned({1, 1, size})), Winding::kept) << size;
    EXPECT_EQ(windingOf(turned({size, -size, size})), Winding::turned) << size;
  }
}

}  // namespace

}  // namespace lensgraph
