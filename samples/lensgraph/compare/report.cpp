// Comparisons as text and JSON: see report.h.
#include "samples/lensgraph/compare/report.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

namespace lensgraph::cli {
namespace {

using Json = nlohmann::ordered_json;

Json pictureJson(const Comparison& comparison, const ComparedPicture& picture) {
  const auto& metrics = picture.quality.metrics;
  Json json = host::toJson(picture.quality);
  const Json masks = json["masks"];
  json.erase("masks");
  json["maxErrorLinear"] = host::jsonNumber(metrics.maxErrorLinear);
  json["pixelCount"] = metrics.pixelCount;
  json["nonFiniteReference"] = metrics.nonFiniteReference;
  json["hdrFlip"] = host::jsonNumber(picture.hdrFlip);
  const auto& range = comparison.hdrExposures;
  json["hdrFlipExposures"] = {{"firstEv", range.firstEv}, {"lastEv", range.lastEv}, {"count", range.count}};
  if (!comparison.masks.empty()) json["masks"] = masks;
  return json;
}

std::string figure(const std::optional<double>& value, int digits) {
  return value ? fmt::format("{:.{}f}", *value, digits) : "none";
}

std::string allLines(const Comparison& comparison, const ComparedPicture& picture) {
  const auto& metrics = picture.quality.metrics;
  const auto& range = comparison.hdrExposures;
  std::string text = fmt::format("PSNR           {:.3f} dB\n", metrics.psnr);
  text += fmt::format("SSIM           {}\n", metrics.ssim ? figure(metrics.ssim, 5) : "none: the picture is too small");
  text += fmt::format("FLIP           {:.5f}\n", picture.quality.flip);
  text += fmt::format("HDR-FLIP       {:.5f} over {} exposures from {:.2f} to {:.2f} EV\n", picture.hdrFlip,
                      range.count, range.firstEv, range.lastEv);
  text += fmt::format("maximum error  {:.6g} displayed, {:.6g} linear\n", metrics.maxErrorDisplayed,
                      metrics.maxErrorLinear);
  text += fmt::format("relative RMSE  {:.6g}\n", metrics.relativeRmse);
  if (metrics.nonFinitePixels + metrics.nonFiniteReference > 0) {
    text += fmt::format("not finite     {} pixels, {} of the reference\n", metrics.nonFinitePixels,
                        metrics.nonFiniteReference);
  }
  return text;
}

size_t nameWidth(const Comparison& comparison) {
  size_t width = 7;  // "picture"
  for (const auto& picture : comparison.pictures) width = std::max(width, picture.file.string().size());
  return width;
}

std::string pictureTable(const Comparison& comparison) {
  const size_t width = nameWidth(comparison);
  std::string text = fmt::format("{:<{}}  {:>8}  {:>7}  {:>7}  {:>8}  {:>9}  {:>9}  {:>10}\n", "picture", width,
                                 "PSNR, dB", "SSIM", "FLIP", "HDR-FLIP", "max error", "rel. RMSE", "not finite");
  for (const auto& picture : comparison.pictures) {
    const auto& metrics = picture.quality.metrics;
    text += fmt::format("{:<{}}  {:>8.3f}  {:>7}  {:>7.5f}  {:>8.5f}  {:>9.5f}  {:>9.6g}  {:>10}\n",
                        picture.file.string(), width, metrics.psnr, figure(metrics.ssim, 5), picture.quality.flip,
                        picture.hdrFlip, metrics.maxErrorDisplayed, metrics.relativeRmse, metrics.nonFinitePixels);
  }
  return text;
}

// The figures of all pictures under one mask.
std::string maskTable(const Comparison& comparison, size_t mask) {
  const auto& first = comparison.pictures.front().quality.masks[mask];
  std::string text =
      fmt::format("\n{}: {} pixels, {:.2f} % of the picture\n", first.name, first.pixels, 100.0 * first.share);
  if (first.pixels == 0) return text;
  const size_t width = nameWidth(comparison);
  text += fmt::format("{:<{}}  {:>8}  {:>7}  {:>7}\n", "picture", width, "PSNR, dB", "SSIM", "FLIP");
  for (const auto& picture : comparison.pictures) {
    const auto& under = picture.quality.masks[mask];
    text += fmt::format("{:<{}}  {:>8}  {:>7}  {:>7}\n", picture.file.string(), width, figure(under.psnr, 3),
                        figure(under.ssim, 5), figure(under.flip, 5));
  }
  return text;
}

}  // namespace

nlohmann::ordered_json reportJson(const Comparison& comparison) {
  const Json common = {{"reference", comparison.referenceFile.string()}, {"exposureEv", comparison.exposureEv}};
  std::vector<Json> pictures;
  for (const auto& picture : comparison.pictures) {
    Json json = {{"picture", picture.file.string()}};
    if (comparison.pictures.size() == 1) json.update(common);
    json.update(pictureJson(comparison, picture));
    pictures.push_back(std::move(json));
  }
  if (pictures.size() == 1) return pictures.front();
  Json json = common;
  json["pictures"] = pictures;
  return json;
}

std::string reportText(const Comparison& comparison) {
  std::string text =
      comparison.pictures.size() == 1 ? allLines(comparison, comparison.pictures.front()) : pictureTable(comparison);
  for (size_t i = 0; i < comparison.masks.size(); ++i) text += maskTable(comparison, i);
  return text;
}

}  // namespace lensgraph::cli
