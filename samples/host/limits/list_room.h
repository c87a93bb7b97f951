// Room in the per-pixel lists of a scene's drawing: how much a frame lacked, and how much the device can give.
#pragma once

#include <functional>

#include "passes/dof_io.h"
#include "shaders/shared/statistics.h"

namespace lensgraph::host {

/// Of all lists, in fragments a pixel, as passes::SceneDraw has it.
struct Rooms {
  float transparentNodes = 0.0f, fragmentNodes = 0.0f, listFragments = 0.0f;
  bool operator==(const Rooms&) const = default;
};

Rooms roomsOf(const passes::SceneDraw& scene);
void setRooms(const Rooms& rooms, passes::SceneDraw& scene);

/// Whether something was left out of a frame for want of room; fragment nodes that are capped do not count.
bool lacksRoom(const shared::FrameStatistics& frame, bool nodesAreCapped);

/// Sets the room of what was too small to a quarter more than was needed, so that neighbouring views fit too.
void makeRoom(const shared::FrameStatistics& frame, double pixels, bool nodesAreCapped, passes::SceneDraw& scene);

/// Sets the most room for fragment nodes between `fitting` and what the scene has now, which is too much. They alone can
/// do with less than was asked for: a list that is full keeps its nearest fragments. `fits` is asked about the room that
/// the scene has then. False when it does not even fit with `fitting`.
bool setMostFragmentNodes(float fitting, const std::function<bool()>& fits, passes::SceneDraw& scene);

}  // namespace lensgraph::host
