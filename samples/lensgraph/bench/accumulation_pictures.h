// The pictures of one progressive accumulation, with 4, 8, 16 … views and with all of them: the curve that every technique
// is held against, and the reference where a shot has no other. Kept in a folder, so that they are rendered once.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "engine/image/image.h"
#include "samples/host/renderer.h"
#include "samples/host/shot.h"

namespace lensgraph::cli {

struct AccumulatedPicture {
  int samples = 0;  ///< Views from the lens.
  engine::FloatImage picture;
};

struct AccumulationPictures {
  std::vector<AccumulatedPicture> curve;  ///< 4, 8 … 256 views.
  engine::FloatImage reference;           ///< With all views.
  std::string commit;                     ///< Of the program that rendered them.
};

/// Views of the first and the last point of the curve.
inline constexpr int kFirstCurveSamples = 4, kLastCurveSamples = 256;

/// Reads the pictures from `folder`, or renders `samples` (at least kLastCurveSamples) views and puts them there. The
/// name of their place holds a hash of the shot's files, its size, its faces, `samples` and `device` (its name and driver).
/// What cannot be read again is rendered again. `progress` is told the share
/// that is rendered, 0…1.
AccumulationPictures accumulationPictures(host::Renderer& renderer, const host::Shot& shot, int samples,
                                          const std::string& caseId, const std::string& device,
                                          const std::filesystem::path& folder,
                                          const std::function<void(double)>& progress);

}  // namespace lensgraph::cli
