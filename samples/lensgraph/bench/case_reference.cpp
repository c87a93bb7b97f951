// Quality figures of a case's pictures: see case_reference.h.
#include "samples/lensgraph/bench/case_reference.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "samples/host/measures/coc_picture.h"
#include "samples/host/measures/quality.h"

namespace lensgraph::cli {
namespace {

using nlohmann::ordered_json;

/// The pinhole picture's depth, one sample at each pixel's center.
engine::FloatImage depthOf(host::Renderer& renderer, const host::Shot& shot) {
  host::RenderOptions options;
  options.technique = "pinhole";
  options.wantDepth = true;
  return renderer.render(shot, options).depth;
}

}  // namespace

CaseReference::CaseReference(host::Renderer& renderer, const host::Shot& shot, engine::FloatImage picture,
                             double exposureEv)
    : picture_(std::move(picture)),
      exposureEv_(exposureEv),
      masks_(engine::failureMasks(host::cocPicture(depthOf(renderer, shot), shot), picture_)) {}

ordered_json CaseReference::maskShares() const {
  ordered_json shares = ordered_json::object();
  for (const auto& mask : masks_) {
    double sum = 0.0;
    for (const float inside : mask.pixels.samples) sum += inside;
    shares[std::string(mask.name)] = sum / static_cast<double>(mask.pixels.pixelCount());
  }
  return shares;
}

ordered_json CaseReference::quality(const engine::FloatImage& picture) const {
  return host::toJson(host::measureQuality(picture, picture_, masks_, exposureEv_));
}

ordered_json CaseReference::curveQuality(const engine::FloatImage& picture) const {
  const auto quality = host::measureQuality(picture, picture_, {}, exposureEv_);
  const auto& ssim = quality.metrics.ssim;
  return {{"psnr", host::jsonNumber(quality.metrics.psnr)},
          {"ssim", ssim ? host::jsonNumber(*ssim) : ordered_json()},
          {"flip", quality.flip}};
}

}  // namespace lensgraph::cli
