// Figures of one picture against its reference: see quality.h.
#include "samples/host/measures/quality.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "engine/metrics/flip.h"

namespace lensgraph::host {
namespace {

nlohmann::ordered_json jsonFigure(const std::optional<double>& value) {
  return value ? jsonNumber(*value) : nlohmann::ordered_json();
}

}  // namespace

Quality measureQuality(const engine::FloatImage& picture, const engine::FloatImage& reference,
                       const std::vector<engine::FailureMask>& masks, double exposureEv, engine::FloatImage* flipMap) {
  std::vector<const engine::FloatImage*> selections = {nullptr};
  for (const auto& mask : masks) selections.push_back(&mask.pixels);
  const auto metrics = engine::compareUnderMasks(picture, reference, exposureEv, selections);
  engine::Flip flip = engine::flip(picture, reference, {.exposureEv = exposureEv});

  Quality quality{.metrics = *metrics.front(), .flip = flip.mean, .masks = {}};
  for (size_t i = 0; i < masks.size(); ++i) {
    MaskQuality under{.name = std::string(masks[i].name)};
    if (const auto& measured = metrics[i + 1]) {
      under.pixels = measured->pixelCount;
      under.share = static_cast<double>(under.pixels) / static_cast<double>(picture.pixelCount());
      under.psnr = measured->psnr;
      under.ssim = measured->ssim;
      under.flip = engine::meanUnderMask(flip.map, masks[i].pixels);
    }
    quality.masks.push_back(std::move(under));
  }
  if (flipMap != nullptr) *flipMap = std::move(flip.map);
  return quality;
}

nlohmann::ordered_json toJson(const Quality& quality) {
  return {{"psnr", jsonNumber(quality.metrics.psnr)},
          {"ssim", jsonFigure(quality.metrics.ssim)},
          {"flip", jsonNumber(quality.flip)},
          {"relativeRmse", jsonNumber(quality.metrics.relativeRmse)},
          {"maxError", jsonNumber(quality.metrics.maxErrorDisplayed)},
          {"nonFinitePixels", quality.metrics.nonFinitePixels},
          {"masks", masksToJson(quality.masks)}};
}

nlohmann::ordered_json masksToJson(const std::vector<MaskQuality>& masks) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const auto& mask : masks) {
    if (mask.pixels == 0) {
      json[mask.name] = nullptr;
      continue;
    }
    json[mask.name] = {{"pixels", mask.pixels},
                       {"share", jsonNumber(mask.share)},
                       {"psnr", jsonFigure(mask.psnr)},
                       {"ssim", jsonFigure(mask.ssim)},
                       {"flip", jsonFigure(mask.flip)}};
  }
  return json;
}

nlohmann::ordered_json jsonNumber(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0.0 ? "infinity" : "-infinity";
  return value;
}

}  // namespace lensgraph::host
