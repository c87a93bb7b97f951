// The room that is set is the most that fits, for each kind of list.
#include "samples/host/limits/list_room.h"

#include <gtest/gtest.h>

namespace lensgraph::host {
namespace {

/// A frame whose fragment nodes found no room.
shared::FrameStatistics lackingNodes(uint32_t needed) {
  shared::FrameStatistics frame{};
  frame.fragmentNodes = needed;
  frame.fragmentNodesDropped = 1;
  return frame;
}

TEST(RoomSearch, GrowsOnlyWhatWasLacking) {
  passes::SceneDraw scene;
  const Rooms before = roomsOf(scene);
  EXPECT_FALSE(lacksRoom({}, false));
  EXPECT_TRUE(lacksRoom(lackingNodes(1000), false));
  EXPECT_FALSE(lacksRoom(lackingNodes(1000), true));
  RoomSearch(scene).grow(lackingNodes(1000), 100.0);
  EXPECT_FLOAT_EQ(roomsOf(scene).fragmentNodes, 12.5f);
  EXPECT_EQ(roomsOf(scene).listFragments, before.listFragments);
  EXPECT_EQ(roomsOf(scene).transparentNodes, before.transparentNodes);
}

TEST(RoomSearch, CapsFragmentNodesAtTheMostThatFits) {
  passes::SceneDraw scene;
  const Rooms plain = roomsOf(scene);
  RoomSearch search(scene);
  search.grow(lackingNodes(10000), 100.0);  // 125 a pixel
  ASSERT_TRUE(search.giveWay([&] { return scene.fragmentNodesPerPixel <= 40.0f; }));
  EXPECT_TRUE(search.nodesAreCapped());
  EXPECT_LE(scene.fragmentNodesPerPixel, 40.0f);
  EXPECT_GT(scene.fragmentNodesPerPixel, 39.8f);
  EXPECT_EQ(roomsOf(scene).listFragments, plain.listFragments);

  const float capped = scene.fragmentNodesPerPixel;
  search.grow(lackingNodes(10000), 100.0);
  EXPECT_EQ(scene.fragmentNodesPerPixel, capped) << "capped nodes do not grow again";
}

TEST(RoomSearch, EndsWhateverDoesNotFit) {
  passes::SceneDraw scene;
  scene.listFragmentsPerPixel = 1000.0f;  // Left by an earlier picture.
  RoomSearch search(scene);
  int given = 0;
  for (; given < 20 && search.giveWay([] { return true; }); ++given) search.grow(lackingNodes(10000), 100.0);
  EXPECT_EQ(given, 2) << "the earlier picture's room, then the nodes'";
}

TEST(RoomSearch, GivesUpWhatAnEarlierPictureLeft) {
  passes::SceneDraw scene;
  const Rooms plain = roomsOf(scene);
  scene.fragmentNodesPerPixel = 500.0f;
  RoomSearch search(scene);
  ASSERT_TRUE(search.giveWay([] { return false; }));
  EXPECT_EQ(roomsOf(scene), plain);
  EXPECT_FALSE(search.giveWay([] { return false; })) << "there is nothing else to give up";
}

}  // namespace
}  // namespace lensgraph::host
