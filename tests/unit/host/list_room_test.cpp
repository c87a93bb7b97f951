// The room that is set is the most that fits, for each kind of list.
#include "samples/host/limits/list_room.h"

#include <gtest/gtest.h>

namespace lensgraph::host {
namespace {

TEST(ListRoom, GrowsOnlyWhereItWasLacking) {
  passes::SceneDraw scene;
  const Rooms before = roomsOf(scene);
  shared::FrameStatistics frame{};
  EXPECT_FALSE(lacksRoom(frame, false));
  frame.fragmentNodes = 1000;
  frame.fragmentNodesDropped = 1;
  EXPECT_TRUE(lacksRoom(frame, false));
  EXPECT_FALSE(lacksRoom(frame, true));
  makeRoom(frame, 100.0, true, scene);
  EXPECT_EQ(roomsOf(scene), before);
  makeRoom(frame, 100.0, false, scene);
  EXPECT_FLOAT_EQ(roomsOf(scene).fragmentNodes, 12.5f);
  EXPECT_EQ(roomsOf(scene).listFragments, before.listFragments);
  EXPECT_EQ(roomsOf(scene).transparentNodes, before.transparentNodes);
}

TEST(ListRoom, OfFragmentNodesIsTheMostThatFits) {
  passes::SceneDraw scene;
  const Rooms fitting = roomsOf(scene);
  scene.fragmentNodesPerPixel = fitting.fragmentNodes + 100.0f;
  const auto fits = [&] { return scene.fragmentNodesPerPixel <= fitting.fragmentNodes + 40.0f; };
  EXPECT_TRUE(setMostFragmentNodes(fitting.fragmentNodes, fits, scene));
  EXPECT_LE(scene.fragmentNodesPerPixel, fitting.fragmentNodes + 40.0f);
  EXPECT_GT(scene.fragmentNodesPerPixel, fitting.fragmentNodes + 39.8f);
  EXPECT_EQ(roomsOf(scene).listFragments, fitting.listFragments);

  EXPECT_FALSE(setMostFragmentNodes(
      fitting.fragmentNodes, [] { return false; }, scene))
      << "something else is too large";
}

}  // namespace
}  // namespace lensgraph::host
