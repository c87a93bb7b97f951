// A sample scene: its glTF and the shots of it. One function per scene, each in a file of its name.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "generate/glb.h"
#include "generate/shot.h"

namespace scenes {

struct Scene {
  Glb glb;
  std::vector<Shot> shots;
};

Scene makeRailingText();
Scene makeCrossingBranches();
Scene makeFoliage();
Scene makeGlassPanes();
Scene makeStreetLights();
Scene makeFigure();
Scene makeReflective();
/// The layout of the scaling scenes; detail grows until at least this many triangles are drawn.
Scene makeForegroundBlur(size_t triangles, const std::string& name);

/// Environment of the lit scenes: longitude-latitude, top row is +Y, the centre column is −Z, +X right of it.
void writeStudioEnvironment(const std::filesystem::path& file);

}  // namespace scenes
