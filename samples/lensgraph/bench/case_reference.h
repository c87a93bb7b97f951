// What the pictures of one case are held against: the reference, and the masks that name failures.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "engine/image/image.h"
#include "engine/metrics/failure_masks.h"
#include "samples/host/renderer.h"
#include "samples/host/shot.h"

namespace lensgraph::cli {

class CaseReference {
 public:
  /// The masks come from the depth of the shot's pinhole picture, which is rendered here. `picture`:
  /// the reference, in the shot's size.
  CaseReference(host::Renderer& renderer, const host::Shot& shot, engine::FloatImage picture, double exposureEv);

  const engine::FloatImage& picture() const { return picture_; }
  const std::vector<engine::FailureMask>& masks() const { return masks_; }
  /// {"nearEdge": share of the pixels, …}
  nlohmann::ordered_json maskShares() const;
  /// Every figure of measures.md, those of each mask included.
  nlohmann::ordered_json quality(const engine::FloatImage& picture) const;
  /// {"psnr", "ssim", "flip"} alone.
  nlohmann::ordered_json curveQuality(const engine::FloatImage& picture) const;

 private:
  engine::FloatImage picture_;
  double exposureEv_;
  std::vector<engine::FailureMask> masks_;
};

}  // namespace lensgraph::cli
