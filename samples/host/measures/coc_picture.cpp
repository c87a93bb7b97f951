// Circles of confusion from depth: see coc_picture.h.
#include "samples/host/measures/coc_picture.h"

#include <algorithm>
#include <cassert>
#include <string>
#include <vector>

#include "engine/scene/scene.h"
#include "passes/lens/physical_lens.h"
#include "samples/host/rendering.h"
#include "samples/host/shot_scene.h"

namespace lensgraph::host {
namespace {
// 1/m; keeps the circle of confusion of a denormal depth finite.
constexpr float kMostVergence = 1e30f;
}  // namespace

engine::FloatImage cocPicture(const engine::FloatImage& depth, const shared::LensConstants& lens) {
  assert(depth.channels == 1);
  engine::FloatImage coc(depth.width, depth.height, 1);
  std::transform(depth.samples.begin(), depth.samples.end(), coc.samples.begin(), [&](float meters) {
    const bool isHit = meters > 0.0f && meters < kNothingHit;  // false for NaN
    return shared::signedCocRadius(lens, isHit ? std::min(1.0f / meters, kMostVergence) : 0.0f);
  });
  return coc;
}

engine::FloatImage cocPicture(const engine::FloatImage& depth, const Shot& shot) {
  engine::Scene scene;
  std::vector<std::string> warnings;  // Of the loader; they matter to whoever renders the scene.
  if (shot.camera.gltfCamera) scene = loadShotScene(shot, warnings);
  const engine::Camera camera = shotCamera(shot, scene);
  const int height = static_cast<int>(depth.height);
  return cocPicture(depth, passes::lensConstants(shot.lens, camera.fovy, height, camera.nearPlane));
}

}  // namespace lensgraph::host
