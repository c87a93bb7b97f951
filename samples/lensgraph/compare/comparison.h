// Pictures measured against one reference, in memory: what `lensgraph compare` prints, writes as maps, and draws on a page.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "engine/image/image.h"
#include "engine/metrics/failure_masks.h"
#include "engine/metrics/hdr_flip.h"
#include "samples/host/measures/quality.h"

namespace lensgraph::cli {

struct ComparedPicture {
  std::filesystem::path file;
  host::Quality quality;
  double hdrFlip = 0.0;  ///< Mean.
  /// Of the picture, only where ComparisonRequest::keepsMaps is true; else empty. Maps have one channel, 0…1.
  engine::FloatImage picture, flipMap, hdrFlipMap;
  engine::FloatImage differenceMap;  ///< Colours of errorMap(), linear light.
};

struct Comparison {
  std::filesystem::path referenceFile;
  engine::FloatImage reference;
  double exposureEv = 0.0;                 ///< Stops; of all figures but HDR-FLIP, relative RMSE and linear errors.
  engine::ExposureRange hdrExposures;      ///< That HDR-FLIP looked at; they follow from the reference.
  std::vector<engine::FailureMask> masks;  ///< Empty where none were asked for.
  std::vector<ComparedPicture> pictures;   ///< In the order given.
};

/// What is to be compared.
struct ComparisonRequest {
  std::vector<std::filesystem::path> pictures;  ///< At least one.
  double exposureEv = 0.0;                      ///< Stops.
  bool keepsMaps = false;                       ///< Pictures and maps stay in memory.
};

/// The reference with its failure masks, and no pictures yet. `coc`: circles of confusion for the masks; null: no masks.
/// Throws engine::Error: sizes differ.
Comparison beginComparison(const std::filesystem::path& referenceFile, engine::FloatImage reference,
                           const engine::FloatImage* coc);

/// Reads and measures the pictures one after the other. Throws engine::Error that names the picture: it cannot be read,
/// its size differs from the reference's.
void measurePictures(const ComparisonRequest& request, Comparison& comparison);

}  // namespace lensgraph::cli
