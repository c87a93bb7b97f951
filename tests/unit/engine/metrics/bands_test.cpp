// Bands cover a picture once, and threads do all the work or pass on what went wrong.
#include "engine/metrics/bands.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

namespace lensgraph {
namespace {

TEST(Bands, CoverEveryRowOnce) {
  for (const uint32_t height : {0u, 1u, 63u, 64u, 65u, 200u}) {
    uint32_t next = 0;
    for (const auto& band : engine::bandsOf(height, 64)) {
      EXPECT_EQ(band.first, next);
      EXPECT_GT(band.end, band.first);
      EXPECT_LE(band.end - band.first, 64u);
      next = band.end;
    }
    EXPECT_EQ(next, height);
  }
}

TEST(Bands, WorkIsDoneOnceForEach) {
  std::vector<std::atomic<int>> done(500);
  engine::forEachInParallel(done.size(), [&](size_t i) { ++done[i]; });
  for (const auto& count : done) EXPECT_EQ(count, 1);
  engine::forEachInParallel(0, [](size_t) { FAIL(); });
}

TEST(Bands, AnExceptionReachesTheCaller) {
  EXPECT_THROW(engine::forEachInParallel(100,
                                         [](size_t i) {
                                           if (i == 37) throw std::runtime_error("37");
                                         }),
               std::runtime_error);
}

}  // namespace
}  // namespace lensgraph
