// Quality figures of a case's pictures: see case_reference.h.
#include "samples/lensgraph/bench/case_reference.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "engine/image/metrics.h"
#include "samples/lensgraph/capture/capture_file.h"

namespace lensgraph::cli {

using nlohmann::ordered_json;

CaseReference::CaseReference(host::Renderer&, const host::Shot&, engine::FloatImage picture, double exposureEv)
    : picture_(std::move(picture)), exposureEv_(exposureEv) {}

ordered_json CaseReference::maskShares() const {
  return ordered_json::object();
}

ordered_json CaseReference::quality(const engine::FloatImage& picture) const {
  const auto metrics = engine::compareImages(picture, picture_, {.exposureEv = exposureEv_, .mask = nullptr});
  return {{"psnr", toJson(metrics.psnr)},
          {"ssim", metrics.ssim ? ordered_json(*metrics.ssim) : ordered_json()},
          {"relativeRmse", toJson(metrics.relativeRmse)},
          {"maxError", metrics.maxErrorDisplayed},
          {"nonFinitePixels", metrics.nonFinitePixels}};
}

ordered_json CaseReference::curveQuality(const engine::FloatImage& picture) const {
  ordered_json all = quality(picture);
  return {{"psnr", all["psnr"]}, {"ssim", all["ssim"]}, {"flip", all["flip"]}};
}

}  // namespace lensgraph::cli
