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

/// Whether something was left out of a frame for want of room; fragment nodes that are capped do not count.
bool lacksRoom(const shared::FrameStatistics& frame, bool nodesAreCapped);

/// The search for the room that one picture needs, frame by frame, changing the scene's. It ends: room grows to what was
/// asked for, fragment nodes are capped at most twice, and room that an earlier picture left is given up at most once.
class RoomSearch {
 public:
  /// The scene outlives it.
  explicit RoomSearch(passes::SceneDraw& scene) : scene_(scene), before_(roomsOf(scene)) {}

  /// Fragment nodes have all the room that the device can give, and what found none is left out. They alone can do with
  /// less than was asked for: a list that is full keeps its nearest fragments.
  bool nodesAreCapped() const { return nodesAreCapped_; }
  /// After a frame that lacked room: a quarter more than was needed, so that neighbouring views fit too.
  void grow(const shared::FrameStatistics& frame, double pixels);
  /// After a frame that the device cannot hold: less room. `fits` is asked whether a frame could be compiled with the
  /// room that the scene has then. False when nothing is left to try.
  bool giveWay(const std::function<bool()>& fits);

 private:
  bool capNodes(const std::function<bool()>& fits);

  passes::SceneDraw& scene_;
  Rooms before_;  ///< What the last frame had that could be compiled, or the one before the first.
  bool nodesAreCapped_ = false;
  bool isFresh_ = false;  ///< The room was not left by an earlier picture.
};

}  // namespace lensgraph::host
