// The page of `lensgraph compare --page`: pictures against one reference, as one self-contained HTML file.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "engine/image/image.h"
#include "samples/lensgraph/pages/page_pictures.h"

namespace lensgraph::cli {

struct ComparePagePicture {
  std::string name;                           ///< As the page shows it; need not be unique.
  engine::FloatImage image;                   ///< Of the reference's size.
  std::optional<engine::FloatImage> flipMap;  ///< One channel, 0…1, of the same size.
  /// The figures: "psnr", "ssim", "flip", "relativeRmse", "maxError", "nonFinitePixels", and "masks", an object of mask
  /// name to {"psnr", "ssim", "pixels"} or null. Each may be absent or null; those that are not finite are strings.
  nlohmann::ordered_json figures;
};

struct ComparePageMask {
  std::string name;         ///< Unique.
  engine::FloatImage mask;  ///< One channel, of the reference's size; pixels above 0 belong to the mask.
};

struct ComparePageContent {
  std::string title;          ///< Heading of the page.
  std::string program;        ///< Version and commit of the program, as the page's head shows it; may be empty.
  double exposureEv = 0.0;    ///< Stops by which pictures are brightened before they are displayed.
  std::string referenceName;  ///< As the page shows it.
  engine::FloatImage reference;
  std::vector<ComparePagePicture> pictures;  ///< At least one.
  std::vector<ComparePageMask> masks;
};

/// One self-contained HTML document. `longestSide`: px; larger pictures are scaled down for the page.
/// Throws engine::Error when the program was built without d3.
std::string comparePage(const ComparePageContent& comparison, uint32_t longestSide = kLongestSideInPages);

}  // namespace lensgraph::cli
