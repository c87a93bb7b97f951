// Room in the per-pixel lists: see list_room.h.
#include "samples/host/limits/list_room.h"

namespace lensgraph::host {

Rooms roomsOf(const passes::SceneDraw& scene) {
  return {scene.transparentNodesPerPixel, scene.fragmentNodesPerPixel, scene.listFragmentsPerPixel};
}

bool lacksRoom(const shared::FrameStatistics& frame, bool nodesAreCapped) {
  return frame.transparentDropped > 0 || frame.listFragmentsDropped > 0 ||
         (frame.fragmentNodesDropped > 0 && !nodesAreCapped);
}

void RoomSearch::grow(const shared::FrameStatistics& frame, double pixels) {
  before_ = roomsOf(scene_);
  const auto perPixel = [&](uint32_t needed) { return static_cast<float>(1.25 * needed / pixels); };
  if (frame.transparentDropped > 0) scene_.transparentNodesPerPixel = perPixel(frame.transparentNodes);
  if (frame.fragmentNodesDropped > 0 && !nodesAreCapped_) scene_.fragmentNodesPerPixel = perPixel(frame.fragmentNodes);
  if (frame.listFragmentsDropped > 0) scene_.listFragmentsPerPixel = perPixel(frame.listFragments);
}

bool RoomSearch::capNodes(const std::function<bool()>& fits) {
  constexpr int kSteps = 10;  // A thousandth of the way.
  float& room = scene_.fragmentNodesPerPixel;
  float fitting = before_.fragmentNodes, tooMuch = room;
  if (!(tooMuch > fitting)) return false;
  room = fitting;
  if (!fits()) return false;
  for (int i = 0; i < kSteps; ++i) {
    room = 0.5f * (fitting + tooMuch);
    (fits() ? fitting : tooMuch) = room;
  }
  room = fitting;
  nodesAreCapped_ = true;
  return true;
}

bool RoomSearch::giveWay(const std::function<bool()>& fits) {
  if (!nodesAreCapped_ && capNodes(fits)) return true;
  // What an earlier, smaller picture needed a pixel may be too much here, and more than this one needs.
  const passes::SceneDraw plain;
  if (isFresh_ || roomsOf(scene_) == roomsOf(plain)) return false;
  isFresh_ = true;
  nodesAreCapped_ = false;
  scene_.transparentNodesPerPixel = plain.transparentNodesPerPixel;
  scene_.fragmentNodesPerPixel = plain.fragmentNodesPerPixel;
  scene_.listFragmentsPerPixel = plain.listFragmentsPerPixel;
  before_ = roomsOf(scene_);
  return true;
}

}  // namespace lensgraph::host
