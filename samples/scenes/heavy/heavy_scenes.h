// Scenes that cost what a game's view costs: several 100 000 to millions of triangles with textures and lit shading, and
// one in which many surfaces lie behind each other. Made on demand, never committed.
#pragma once

#include <cstddef>
#include <string>

#include "generate/scene.h"
#include "parts/sky.h"

namespace scenes {

/// A scene of one shot; NAME.glb, NAME.json and NAME_sky.exr belong together.
struct HeavyScene {
  std::string name;
  /// The most effort for the textures would take three times as long as all the rest, and save a seventh of them.
  Scene scene{.glb = Glb(4), .shots = {}};
  Sky sky;
};

constexpr size_t kStreetTriangles = 300'000;    ///< Drawn at least.
constexpr size_t kForestTriangles = 1'500'000;  ///< Drawn at least.
constexpr double kDeepSurfaces = 10.0;          ///< Front faces behind a pixel of `deep`, at least, in the mean.

HeavyScene makeStreet();
HeavyScene makeForest();
HeavyScene makeDeep();

}  // namespace scenes
