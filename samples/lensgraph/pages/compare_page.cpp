// The page of a comparison: see compare_page.h. What the page shows is drawn by compare_page.js, in the browser.
#include "samples/lensgraph/pages/compare_page.h"

#include "samples/lensgraph/pages/embedded_page.h"
#include "samples/lensgraph/pages/shared_page.h"

namespace lensgraph::cli {
namespace {

using nlohmann::ordered_json;

constexpr char kPage[] = {
#include "generated/compare_page.inc"
};
constexpr char kScript[] = {
#include "generated/compare_page_script.inc"
};

ordered_json pictureJson(const ComparePagePicture& picture, double exposureEv, uint32_t longestSide) {
  return {{"name", picture.name},
          {"figures", picture.figures},
          {"picture", pictureUri(picture.image, exposureEv, longestSide)},
          {"flipMap", picture.flipMap ? ordered_json(mapUri(*picture.flipMap, longestSide)) : ordered_json()}};
}

}  // namespace

std::string comparePage(const ComparePageContent& comparison, uint32_t longestSide) {
  requireD3("compare --page");
  ordered_json pictures = ordered_json::array(), masks = ordered_json::array();
  for (const auto& picture : comparison.pictures) {
    pictures.push_back(pictureJson(picture, comparison.exposureEv, longestSide));
  }
  for (const auto& mask : comparison.masks) {
    masks.push_back({{"name", mask.name}, {"picture", mapUri(mask.mask, longestSide)}});
  }
  const ordered_json data = {{"title", comparison.title},
                             {"program", comparison.program},
                             {"exposureEv", comparison.exposureEv},
                             {"width", comparison.reference.width},
                             {"height", comparison.reference.height},
                             {"referenceName", comparison.referenceName},
                             {"reference", pictureUri(comparison.reference, comparison.exposureEv, longestSide)},
                             {"pictures", std::move(pictures)},
                             {"masks", std::move(masks)}};
  return filledPage(textOf(kPage), textOf(kScript), data);
}

}  // namespace lensgraph::cli
