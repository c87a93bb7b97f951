// lensgraph compare: how far a picture is from its reference.
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>

#include "engine/image/image_io.h"
#include "engine/metrics/metrics.h"
#include "samples/lensgraph/capture/capture_file.h"
#include "samples/lensgraph/subcommands.h"

namespace lensgraph::cli {

int runCompare(const CompareArguments& arguments) {
  const auto picture = engine::readImage(arguments.picture);
  const auto reference = engine::readImage(arguments.reference);
  const auto metrics = engine::compareImages(picture, reference, {.exposureEv = arguments.exposureEv, .mask = nullptr});
  if (arguments.json) {
    const nlohmann::ordered_json json = {
        {"picture", arguments.picture.string()},
        {"reference", arguments.reference.string()},
        {"exposureEv", arguments.exposureEv},
        {"psnr", toJson(metrics.psnr)},
        {"ssim", metrics.ssim ? toJson(*metrics.ssim) : nlohmann::json()},
        {"maxError", toJson(metrics.maxErrorDisplayed)},
        {"maxErrorLinear", toJson(metrics.maxErrorLinear)},
        {"relativeRmse", toJson(metrics.relativeRmse)},
        {"pixelCount", metrics.pixelCount},
        {"nonFinitePixels", metrics.nonFinitePixels},
        {"nonFiniteReference", metrics.nonFiniteReference},
    };
    std::cout << json.dump(2) << "\n";
    return 0;
  }
  std::printf("PSNR           %.3f dB\n", metrics.psnr);
  if (metrics.ssim) {
    std::printf("SSIM           %.5f\n", *metrics.ssim);
  } else {
    std::printf("SSIM           none: the picture is too small\n");
  }
  std::printf("maximum error  %.6g displayed, %.6g linear\n", metrics.maxErrorDisplayed, metrics.maxErrorLinear);
  std::printf("relative RMSE  %.6g\n", metrics.relativeRmse);
  if (metrics.nonFinitePixels + metrics.nonFiniteReference > 0) {
    std::printf("not finite     %llu pixels, %llu of the reference\n",
                static_cast<unsigned long long>(metrics.nonFinitePixels),
                static_cast<unsigned long long>(metrics.nonFiniteReference));
  }
  return 0;
}

}  // namespace lensgraph::cli
