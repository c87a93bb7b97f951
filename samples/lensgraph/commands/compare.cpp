// lensgraph compare: how far pictures are from their reference, also where depth of field is known to fail.
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "engine/error.h"
#include "engine/image/image_io.h"
#include "samples/host/measures/coc_picture.h"
#include "samples/lensgraph/compare/comparison.h"
#include "samples/lensgraph/compare/map_files.h"
#include "samples/lensgraph/compare/report.h"
#include "samples/lensgraph/output.h"
#include "samples/lensgraph/pages/compare_page.h"
#include "samples/lensgraph/pages/embedded_page.h"
#include "samples/lensgraph/progress.h"
#include "samples/lensgraph/session.h"
#include "samples/lensgraph/subcommands.h"
#include "samples/lensgraph/version.h"

namespace lensgraph::cli {
namespace {

/// Exit code and depth of the shot seen through a pinhole, at its own resolution.
std::pair<int, engine::FloatImage> renderDepth(const host::Shot& shot, const GlobalArguments& global) {
  Session session(global);
  std::vector<std::string> warnings;
  host::Renderer renderer(session.device(), shot, warnings);
  Session::report(warnings);
  host::Rendering rendering = renderer.render(shot, {.technique = "pinhole", .wantDepth = true});
  return {session.finish(), std::move(rendering.depth)};
}

struct Blur {
  int exitCode = 0;  ///< Of the rendering, where there was one.
  engine::FloatImage coc;
};

/// Circles of confusion for pictures of the reference's size.
Blur blurOf(const CompareArguments& arguments, const engine::FloatImage& reference, const GlobalArguments& global) {
  host::Shot shot = host::readShot(*arguments.shot);
  shot.width = static_cast<int>(reference.width);
  shot.height = static_cast<int>(reference.height);
  if (!arguments.depth) {
    const auto [exitCode, depth] = renderDepth(shot, global);
    return {exitCode, host::cocPicture(depth, shot)};
  }
  const engine::FloatImage depth = engine::readDepth(*arguments.depth);
  if (depth.width != reference.width || depth.height != reference.height) {
    throw engine::Error({.file = arguments.depth->string(),
                         .field = "--depth",
                         .reason = "is " + std::to_string(depth.width) + "x" + std::to_string(depth.height) +
                                   ", the pictures are " + std::to_string(reference.width) + "x" +
                                   std::to_string(reference.height),
                         .remedy = "give depth of their size, or leave --depth out"});
  }
  return {0, host::cocPicture(depth, shot)};
}

/// The page that shows the comparison. Takes its pictures.
std::string pageOf(Comparison comparison) {
  ComparePageContent content;
  content.title = comparison.referenceFile.filename().string() + " and pictures of it";
  content.program = programName();
  content.exposureEv = comparison.exposureEv;
  content.referenceName = comparison.referenceFile.filename().string();
  content.reference = std::move(comparison.reference);
  for (auto& picture : comparison.pictures) {
    content.pictures.push_back({.name = picture.file.string(),
                                .image = std::move(picture.picture),
                                .flipMap = std::move(picture.flipMap),
                                .figures = host::toJson(picture.quality)});
  }
  for (auto& mask : comparison.masks) content.masks.push_back({std::string(mask.name), std::move(mask.pixels)});
  return comparePage(content);
}

}  // namespace

int runCompare(const CompareArguments& arguments, const GlobalArguments& global) {
  if (arguments.maps) checkMapFolder(*arguments.maps);
  if (arguments.page) {
    requireD3("compare --page");
    checkOutput(*arguments.page, "--page");
  }
  engine::FloatImage reference = engine::readImage(arguments.reference);
  std::optional<Blur> blur;
  if (arguments.shot) blur = blurOf(arguments, reference, global);
  Comparison comparison = beginComparison(arguments.reference, std::move(reference), blur ? &blur->coc : nullptr);
  const ComparisonRequest request{.pictures = arguments.pictures,
                                  .exposureEv = arguments.exposureEv,
                                  .keepsMaps = arguments.maps || arguments.page};
  measurePictures(request, comparison);
  if (arguments.maps) writeMaps(comparison, *arguments.maps);
  if (arguments.json) {
    std::cout << reportJson(comparison).dump(2) << "\n";
  } else {
    std::cout << reportText(comparison);
  }
  if (arguments.page) writeTextFile(*arguments.page, pageOf(std::move(comparison)));
  return blur ? blur->exitCode : 0;
}

}  // namespace lensgraph::cli
