// The quality of one picture against its reference: the figures that `lensgraph compare` and `lensgraph bench` report.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "engine/image/image.h"
#include "engine/metrics/failure_masks.h"
#include "engine/metrics/metrics.h"

namespace lensgraph::host {

/// The figures under one mask. engine/metrics/ says what each of them means.
struct MaskQuality {
  std::string name;                        ///< The mask's.
  uint64_t pixels = 0;                     ///< In the mask.
  double share = 0.0;                      ///< Of the picture's pixels, 0…1.
  std::optional<double> psnr, ssim, flip;  ///< None when the mask is empty; no ssim either when it lies in the border.
};

struct Quality {
  engine::Metrics metrics;         ///< Of the whole picture: psnr, ssim, relativeRmse, errors, counts.
  double flip = 0.0;               ///< Mean LDR-FLIP of the displayed pictures.
  std::vector<MaskQuality> masks;  ///< As given to measureQuality().
};

/// Measures a picture against its reference, both in linear light and of one size. `masks`: from
/// engine::failureMasks(), or none. `exposureEv`: stops by which both are brightened before they are displayed (PSNR, SSIM,
/// maximum error, FLIP). `flipMap`: receives the map of FLIP, one channel, unless it is null. Throws engine::Error: sizes or
/// channels that do not fit.
Quality measureQuality(const engine::FloatImage& picture, const engine::FloatImage& reference,
                       const std::vector<engine::FailureMask>& masks, double exposureEv,
                       engine::FloatImage* flipMap = nullptr);

/// {"psnr", "ssim", "flip", "relativeRmse", "maxError", "nonFinitePixels", "masks": {NAME: {"pixels", "share", "psnr",
/// "ssim", "flip"}, …}}. The entry of an empty mask is null. Numbers that are not finite are "infinity", "-infinity",
/// "nan"; absent figures are null.
nlohmann::ordered_json toJson(const Quality& quality);

/// The value of "masks" alone.
nlohmann::ordered_json masksToJson(const std::vector<MaskQuality>& masks);

/// A number, or "infinity", "-infinity", "nan", which JSON numbers cannot be.
nlohmann::ordered_json jsonNumber(double value);

}  // namespace lensgraph::host
