// Measures pictures against a reference: see comparison.h.
#include "samples/lensgraph/compare/comparison.h"

#include <string>
#include <utility>

#include "engine/error.h"
#include "engine/image/image_io.h"
#include "samples/lensgraph/error_map.h"

namespace lensgraph::cli {
namespace {

std::string sizeOf(const engine::FloatImage& image) {
  return std::to_string(image.width) + "x" + std::to_string(image.height);
}

void requireReferenceSize(const std::filesystem::path& file, const engine::FloatImage& picture,
                          const Comparison& comparison) {
  const engine::FloatImage& reference = comparison.reference;
  if (picture.width == reference.width && picture.height == reference.height) return;
  throw engine::Error({.file = file.string(),
                       .field = {},
                       .reason = "is " + sizeOf(picture) + ", the reference " + comparison.referenceFile.string() +
                                 " is " + sizeOf(reference) + ": pictures differ in size",
                       .remedy = "compare pictures of one size"});
}

ComparedPicture measure(const std::filesystem::path& file, const Comparison& comparison, bool keepsMaps) {
  ComparedPicture result{.file = file};
  engine::FloatImage picture = engine::readImage(file);
  requireReferenceSize(file, picture, comparison);
  result.quality = host::measureQuality(picture, comparison.reference, comparison.masks, comparison.exposureEv,
                                        keepsMaps ? &result.flipMap : nullptr);
  engine::HdrFlip hdr = engine::hdrFlip(picture, comparison.reference);
  result.hdrFlip = hdr.mean;
  if (keepsMaps) {
    result.hdrFlipMap = std::move(hdr.map);
    result.differenceMap = errorMap(picture, comparison.reference, comparison.exposureEv);
    result.picture = std::move(picture);
  }
  return result;
}

}  // namespace

Comparison beginComparison(const std::filesystem::path& referenceFile, engine::FloatImage reference,
                           const engine::FloatImage* coc) {
  Comparison comparison{.referenceFile = referenceFile, .reference = std::move(reference)};
  if (coc != nullptr) comparison.masks = engine::failureMasks(*coc, comparison.reference);
  return comparison;
}

void measurePictures(const ComparisonRequest& request, Comparison& comparison) {
  comparison.exposureEv = request.exposureEv;
  comparison.hdrExposures = engine::hdrFlipExposures(comparison.reference);
  for (const auto& file : request.pictures) {
    comparison.pictures.push_back(measure(file, comparison, request.keepsMaps));
  }
}

}  // namespace lensgraph::cli
