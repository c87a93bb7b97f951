// Reading for `lensgraph apply`: see applied_pictures.h.
#include "samples/lensgraph/commands/applied_pictures.h"

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include <cmath>
#include <utility>

#include "engine/error.h"
#include "engine/image/image_io.h"
#include "samples/host/picture_inputs.h"

namespace lensgraph::cli {
namespace {

using host::DepthKind;

[[noreturn]] void failUsage(const std::string& field, const std::string& reason, const std::string& remedy) {
  throw engine::Error({.file = "command line", .field = field, .reason = reason, .remedy = remedy});
}

DepthKind kindOf(const DepthArguments& arguments) {
  const std::string kind = arguments.kind.value_or("z");
  if (kind == "ray") return DepthKind::ray;
  if (kind == "disparity") return DepthKind::disparity;
  if (kind == "normalized") return DepthKind::normalized;
  return DepthKind::z;
}

bool isRange(DepthKind kind) {
  return kind == DepthKind::disparity || kind == DepthKind::normalized;
}

host::DepthMeaning meaningOf(const DepthArguments& arguments, uint32_t largestInteger) {
  host::DepthMeaning meaning;
  meaning.kind = kindOf(arguments);
  meaning.scale = arguments.scale.value_or(1.0);
  meaning.nearest = arguments.nearest.value_or(0.0);
  meaning.farthest = arguments.farthest.value_or(0.0);
  meaning.isWhiteNear = arguments.white ? *arguments.white == "near" : meaning.kind == DepthKind::disparity;
  meaning.white = largestInteger > 0 ? largestInteger : 1.0;
  return meaning;
}

/// "b.exr: part main, layer ViewLayer.Depth, channel Z"
std::string describe(const std::filesystem::path& file, const engine::ChannelsRead& from) {
  std::string text = file.string() + ":";
  if (!from.part.empty()) text += " part " + from.part + ",";
  if (!from.layer.empty() && from.layer != from.part) text += " layer " + from.layer + ",";
  text += from.channels.size() == 1 ? " channel " : " channels ";
  for (std::size_t i = 0; i < from.channels.size(); ++i) {
    const std::string& name = from.channels[i];
    text += (i > 0 ? ", " : "") + name.substr(name.rfind('.') + 1);  // the whole name where there is no dot
  }
  return text;
}

/// "disparity, white is near, from 0.5 to 20 m"
std::string describe(const host::DepthMeaning& meaning) {
  if (!isRange(meaning.kind)) {
    const std::string unit = meaning.scale == 1.0 ? "metres" : fmt::format("units of {:g} m", meaning.scale);
    return unit + (meaning.kind == DepthKind::z ? " along the axis" : " along each pixel's ray");
  }
  return fmt::format("{}, white is {}, between {:g} and {:g} m",
                     meaning.kind == DepthKind::disparity ? "disparity" : "normalized",
                     meaning.isWhiteNear ? "near" : "far", meaning.nearest, meaning.farthest);
}

void requireMeaningOfIntegers(const ApplyArguments& arguments) {
  if (arguments.depthMeaning.scale || isRange(kindOf(arguments.depthMeaning))) return;
  throw engine::Error({.file = arguments.depth.string(),
                       .field = "--depth",
                       .reason = "holds integers, whose unit is not known",
                       .remedy = "give --depth-scale METRES (.001 for millimetres), or --depth-kind disparity or "
                                 "normalized with --depth-near and --depth-far"});
}

/// Numbers that do not fit the focus distance are often no metres.
void warnOfImplausibleDepth(const ApplyArguments& arguments, const host::DepthFindings& found) {
  if (!found.nearest || arguments.depthMeaning.kind || arguments.depthMeaning.scale) return;
  const double nearest = static_cast<double>(*found.nearest), farthest = static_cast<double>(*found.farthest);
  const double focus = arguments.focusDistance;
  // Inverted depths end near 1; a focus behind all that the picture shows is rare. Centimetres are 100 times too large; a
  // focus before everything is less rare.
  constexpr double kBehind = 2.0, kBefore = 10.0;
  const bool isUnit = farthest <= 1.0 && farthest > 0.99;
  const bool isBeyond = focus > kBehind * farthest && (std::isfinite(focus) || isUnit);
  if (!isBeyond && focus >= nearest / kBefore) return;
  spdlog::warn("--depth: values from {:g} to {:g} are far from --focus {:g}: are they {}? See {}", nearest, farthest,
               focus, isBeyond ? "normalized, or disparities" : "metres",
               isBeyond ? "--depth-kind" : "--depth-scale and --depth-kind");
}

void requireSameSize(const ApplyArguments& arguments, const engine::FloatImage& color,
                     const engine::FloatImage& depth) {
  if (color.width == depth.width && color.height == depth.height) return;
  const auto size = [](const auto& image) { return std::to_string(image.width) + "x" + std::to_string(image.height); };
  throw engine::Error({.file = arguments.depth.string(),
                       .field = "--depth",
                       .reason = "is " + size(depth) + " px, the colour picture is " + size(color) + " px",
                       .remedy = "give a depth picture of the same size"});
}

}  // namespace

void checkDepthArguments(const DepthArguments& arguments) {
  const DepthKind kind = kindOf(arguments);
  const std::string name = arguments.kind.value_or("z");
  if (!isRange(kind)) {
    for (const auto& [option, isGiven] : {std::pair{"--depth-near", arguments.nearest.has_value()},
                                          {"--depth-far", arguments.farthest.has_value()},
                                          {"--depth-white", arguments.white.has_value()}}) {
      if (isGiven) failUsage(option, "means nothing for --depth-kind " + name, "give disparity or normalized");
    }
    const double scale = arguments.scale.value_or(1.0);
    if (!(scale > 0.0 && std::isfinite(scale))) failUsage("--depth-scale", "must be above 0 metres", "");
    return;
  }
  if (arguments.scale) {
    failUsage("--depth-scale", "means nothing for --depth-kind " + name, "give --depth-near and --depth-far alone");
  }
  if (!arguments.nearest || !arguments.farthest) {
    failUsage("--depth-kind", name + " needs --depth-near and --depth-far", "give both, in metres");
  }
  if (!(*arguments.nearest > 0.0 && std::isfinite(*arguments.nearest))) {
    failUsage("--depth-near", "must be above 0 metres", "");
  }
  if (!(*arguments.farthest > *arguments.nearest)) failUsage("--depth-far", "must be above --depth-near", "");
  if (kind == DepthKind::normalized && !std::isfinite(*arguments.farthest)) {
    failUsage("--depth-far", "must be finite for --depth-kind normalized", "");
  }
}

AppliedPictures readAppliedPictures(const ApplyArguments& arguments) {
  AppliedPictures pictures;
  auto color = engine::readImage(arguments.color, {.name = arguments.colorLayer, .option = "--color-layer"});
  auto depth = engine::readDepth(arguments.depth, {.name = arguments.depthChannel, .option = "--depth-channel"});
  requireSameSize(arguments, color.image, depth.image);
  if (depth.largestInteger > 0) requireMeaningOfIntegers(arguments);

  const auto pixels = color.image.pixelCount();
  const host::ColorFindings colorFound = host::cleanColor(color.image);
  if (colorFound.notFinite > 0) {
    spdlog::warn("--color: {} of {} pixels are not finite: taken as black", colorFound.notFinite, pixels);
  }
  if (colorFound.limited > 0) {
    spdlog::warn("--color: {} of {} pixels are beyond {:g}: limited to it", colorFound.limited, pixels,
                 host::kLargestColor);
  }

  const host::DepthMeaning meaning = meaningOf(arguments.depthMeaning, depth.largestInteger);
  const host::DepthFindings depthFound = host::convertDepth(depth.image, meaning, arguments.fovyDeg);
  if (depthFound.holes == pixels) {
    throw engine::Error({.file = arguments.depth.string(),
                         .field = "--depth",
                         .reason = "holds no positive depth",
                         .remedy = "give distances, or say with --depth-kind what the values are"});
  }
  if (depthFound.holes > 0) {
    spdlog::warn("--depth: {} of {} depths are not positive (holes?): taken as infinitely far", depthFound.holes,
                 pixels);
  }
  warnOfImplausibleDepth(arguments, depthFound);

  pictures.summary.push_back("color      " + describe(arguments.color, color.from));
  pictures.summary.push_back("depth      " + describe(arguments.depth, depth.from) + "; " + describe(meaning));
  if (depthFound.nearest) {
    pictures.summary.push_back(
        fmt::format("           from {:g} to {:g} m", *depthFound.nearest, *depthFound.farthest));
  }
  pictures.color = std::move(color.image);
  pictures.depth = std::move(depth.image);
  return pictures;
}

}  // namespace lensgraph::cli
