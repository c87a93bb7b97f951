// Levels of the multi-layer filtering: how many, where their cells lie, what they show and drop.
#include "passes/multilayer_filtering/filter_levels.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lensgraph {

namespace {

using namespace passes::multilayer_filtering;

LevelRequest request(double nearCoc, double farCoc) {
  LevelRequest request;
  request.extent = {320, 181};
  request.nearCoc = nearCoc;
  request.farCoc = farCoc;
  return request;
}

TEST(FilterLevels, AreAsManyAsTheBlurAsksFor) {
  EXPECT_EQ(planLevels(request(0.0, 0.0)).levels.size(), 1u);
  for (const auto kernel : {Kernel::round, Kernel::box}) {
    std::size_t before = 1;
    for (const double radius : {0.3, 1.0, 3.0, 10.0, 30.0, 100.0, 1000.0, 1e30}) {
      auto wanted = request(radius, 0.0);
      wanted.kernel = kernel;
      const auto plan = planLevels(wanted);
      EXPECT_GE(plan.levels.size(), before) << radius;
      EXPECT_LE(plan.levels.size(), shared::kMaxFilterLevels) << radius;
      EXPECT_EQ(plan.looks.back().level + 1, plan.levels.size()) << "no level is made that nothing looks up";
      before = plan.levels.size();
      if (radius > 1000.0) continue;
      EXPECT_GE(std::sqrt(plan.looks.back().own), radius) << "the widest look is wide enough";
      EXPECT_LT(std::sqrt(plan.looks.back().inner), radius) << "and needed";
    }
  }
}

TEST(FilterLevels, FollowTheConfiguration) {
  auto wanted = request(20.0, 5.0);
  wanted.kernel = Kernel::box;
  for (const auto& [mip, stack] : {std::pair(1, 3), std::pair(2, 2), std::pair(4, 0), std::pair(0, 4)}) {
    wanted.mipSteps = mip;
    wanted.stackSteps = stack;
    const auto plan = planLevels(wanted);
    ASSERT_EQ(plan.levels.size(), 5u);
    for (int i = 1; i <= 4; ++i) {
      const auto& level = plan.levels[static_cast<std::size_t>(i)];
      EXPECT_EQ(level.tapDistance, i <= mip ? 0 : 1 << (i - 1 - mip)) << mip << "/" << stack << " level " << i;
      EXPECT_EQ(level.cellSize, std::exp2(static_cast<float>(std::min(i, mip))));
    }
  }
}

// Of 2^L px, whatever the configuration, and centred: following the taps down to level 0 gives pixels evenly about the centre.
TEST(FilterLevels, FiltersAreBoxesAboutTheirCentres) {
  for (const int subpixel : {0, 1}) {
    for (const int mip : {0, 1, 3}) {
      auto wanted = request(20.0, 5.0);
      wanted.subpixelSteps = subpixel;
      wanted.mipSteps = mip;
      wanted.border = 100.0;
      const auto plan = planLevels(wanted);
      for (std::size_t i = 0; i < plan.levels.size(); ++i) {
        int first = 7, last = 7;  // a cell, and the pixels that it is made of
        for (std::size_t k = i; k > 0; --k) {
          const int distance = plan.levels[k].tapDistance;
          first = distance == 0 ? 2 * first : first;
          last = distance == 0 ? 2 * last + 1 : last + distance;
        }
        const double pixel = plan.levels[0].cellSize;
        EXPECT_DOUBLE_EQ((last - first + 1) * pixel, std::exp2(static_cast<double>(i)) * pixel);
        EXPECT_DOUBLE_EQ(0.5 * (first + last + 1) * pixel, plan.levels[i].centre + 7.0 * plan.levels[i].cellSize);
      }
    }
  }
}

// Every cell that the picture looks up or a coarser level takes is in the window, but for those beyond the border, which
// repeat the window's own.
TEST(FilterLevels, WindowsHoldWhatIsLookedUp) {
  for (const double border : {0.0, 3.0, 200.0}) {
    for (const int mip : {0, 1, 2, 13}) {
      auto wanted = request(20.0, 5.0);
      wanted.mipSteps = mip;
      wanted.border = border;
      const auto plan = planLevels(wanted);
      uint32_t lists = 0;
      for (std::size_t i = 0; i < plan.levels.size(); ++i) {
        const auto& level = plan.levels[i];
        EXPECT_EQ(level.firstList, lists);
        EXPECT_GT(level.size.x, 0);
        EXPECT_GT(level.size.y, 0);
        lists += static_cast<uint32_t>(level.size.x * level.size.y) + 1;
        if (border < 100.0) continue;
        const auto cell = [&](double place) {
          return static_cast<int>(std::floor((place - level.centre) / level.cellSize));
        };
        EXPECT_LE(level.first.x, cell(0.5));
        EXPECT_LE(level.first.y, cell(0.5));
        for (const auto& look : plan.looks) {
          if (look.level != i || look.ring == 0.0f) continue;
          const auto place = [&](double at) { return (at - level.centre) / level.cellSize; };
          EXPECT_LE(level.first.x, std::ceil(place(0.5) - 0.5 - look.ring));
          EXPECT_GE(level.first.y + level.size.y - 1, std::floor(place(180.5) + 0.5 + look.ring));
        }
        EXPECT_GE(level.first.x + level.size.x - 1, cell(319.5));
        EXPECT_GE(level.first.y + level.size.y - 1, cell(180.5));
        if (i == 0) continue;
        const auto& source = plan.levels[i - 1];
        const int low = level.tapDistance == 0 ? 2 * level.first.x : level.first.x;
        const int last = level.first.x + level.size.x - 1;
        const int high = level.tapDistance == 0 ? 2 * last + 1 : last + level.tapDistance;
        EXPECT_GE(low, source.first.x);
        EXPECT_LE(high, source.first.x + source.size.x - 1);
      }
      EXPECT_EQ(plan.listCount, lists);
      if (border == 0.0) {
        EXPECT_EQ(plan.levels[0].size.x, 320);
        EXPECT_EQ(plan.levels[0].size.y, 181);
      }
    }
  }
}

// Shares of looks sum to 1 everywhere: one's outer border is where the next shows alone.
TEST(FilterLevels, BordersMeet) {
  for (const auto match : {LevelMatch::moments, LevelMatch::diameter}) {
    for (const auto kernel : {Kernel::round, Kernel::box}) {
      for (const int mip : {0, 1, 3}) {
        auto wanted = request(30.0, 5.0);
        wanted.match = match;
        wanted.kernel = kernel;
        wanted.mipSteps = mip;
        const auto plan = planLevels(wanted);
        for (std::size_t i = 1; i < plan.looks.size(); ++i) {
          EXPECT_EQ(plan.looks[i - 1].outer, plan.looks[i].own);
          EXPECT_EQ(plan.looks[i].inner, plan.looks[i - 1].own);
          EXPECT_GT(plan.looks[i].own, plan.looks[i - 1].own);
          EXPECT_GE(plan.looks[i].level, plan.looks[i - 1].level);
          if (match == LevelMatch::diameter) {
            EXPECT_FLOAT_EQ(std::sqrt(plan.looks[i].own), std::exp2(static_cast<float>(i) - 1.0f)) << "2|c| = 2^L";
          }
        }
      }
    }
  }
}

// Eight boxes around the pixel have the second moment of the disc that they stand for.
TEST(FilterLevels, RingsHaveTheMomentOfADisc) {
  const auto plan = planLevels(request(100.0, 5.0));
  int rings = 0;
  for (const auto& look : plan.looks) {
    if (look.ring == 0.0f) continue;
    ++rings;
    const auto& level = plan.levels[look.level];
    const double width = 2.0 * level.centre, ring = double(look.ring) * level.cellSize;
    const double variance = (width * width - 1.0) / 12.0 + 0.5 * ring * ring + level.cellSize * level.cellSize / 12.0;
    EXPECT_NEAR(variance, 0.25 * look.own + 1.0 / 12.0, 0.2 * variance) << "but for taps on whole cells";
    EXPECT_LT(ring, 0.8 * width) << "no hole in the middle";
  }
  EXPECT_GE(rings, 4);
}

TEST(FilterLevels, DropOnlyWhatNothingShows) {
  const auto plan = planLevels(request(30.0, 5.0));
  EXPECT_GT(plan.nearLooks, plan.farLooks);
  for (std::size_t i = plan.looks.size(); i-- > 1;) {
    const auto& look = plan.looks[i];
    const auto& level = plan.levels[look.level];
    EXPECT_LT(level.dropWithin, std::sqrt(look.inner) + 1e-6f) << "what the look shows is kept";
    if (i > 2) {
      EXPECT_GT(level.dropWithin, 0.0f) << "and what is in focus dropped";
    }
    if (i <= plan.farLooks) {
      EXPECT_GT(level.highest, 1e30f);
    } else if (look.level > plan.looks[plan.farLooks].level) {
      EXPECT_LT(level.highest, 30.0f) << "nothing there is as blurred";
    }
    EXPECT_LT(level.lowest, -30.0f) << "coarser levels are made of what is nearer";
  }
  auto all = request(30.0, 5.0);
  all.truncate = false;
  for (const auto& level : planLevels(all).levels) {
    EXPECT_EQ(level.dropWithin, 0.0f);
    EXPECT_GT(level.highest, 1e30f);
  }
}

// A blur wider than the picture must not ask for more cells than memory holds.
TEST(FilterLevels, StayWithinBoundsAtAnyBlur) {
  for (const double radius : {1.0, 50.0, 1e3, 1e6, 1e30}) {
    for (const int subpixel : {0, 2}) {
      auto wanted = request(radius, radius);
      wanted.extent = {48, 27};
      wanted.subpixelSteps = subpixel;
      wanted.border = 24.0;
      EXPECT_LT(planLevels(wanted).listCount, 400000u) << radius;
    }
  }
}

}  // namespace

}  // namespace lensgraph
