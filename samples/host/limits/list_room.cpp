// Room in the per-pixel lists: see list_room.h.
#include "samples/host/limits/list_room.h"

namespace lensgraph::host {
Rooms roomsOf(const passes::SceneDraw& scene) {
  return {scene.transparentNodesPerPixel, scene.fragmentNodesPerPixel, scene.listFragmentsPerPixel};
}

void setRooms(const Rooms& rooms, passes::SceneDraw& scene) {
  scene.transparentNodesPerPixel = rooms.transparentNodes;
  scene.fragmentNodesPerPixel = rooms.fragmentNodes;
  scene.listFragmentsPerPixel = rooms.listFragments;
}

bool lacksRoom(const shared::FrameStatistics& frame, bool nodesAreCapped) {
  return frame.transparentDropped > 0 || frame.listFragmentsDropped > 0 ||
         (frame.fragmentNodesDropped > 0 && !nodesAreCapped);
}

void makeRoom(const shared::FrameStatistics& frame, double pixels, bool nodesAreCapped, passes::SceneDraw& scene) {
  const auto perPixel = [&](uint32_t needed) { return static_cast<float>(1.25 * needed / pixels); };
  if (frame.transparentDropped > 0) scene.transparentNodesPerPixel = perPixel(frame.transparentNodes);
  if (frame.fragmentNodesDropped > 0 && !nodesAreCapped) scene.fragmentNodesPerPixel = perPixel(frame.fragmentNodes);
  if (frame.listFragmentsDropped > 0) scene.listFragmentsPerPixel = perPixel(frame.listFragments);
}

bool setMostFragmentNodes(float fitting, const std::function<bool()>& fits, passes::SceneDraw& scene) {
  constexpr int kSteps = 10;  // A thousandth of the way.
  float& room = scene.fragmentNodesPerPixel;
  float tooMuch = room;
  room = fitting;
  if (!fits()) return false;
  for (int i = 0; i < kSteps; ++i) {
    room = 0.5f * (fitting + tooMuch);
    (fits() ? fitting : tooMuch) = room;
  }
  room = fitting;
  return true;
}

}  // namespace lensgraph::host
