// One progressive run, its intermediate pictures kept: see accumulation_pictures.h.
#include "samples/lensgraph/bench/accumulation_pictures.h"

#include <spdlog/spdlog.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "engine/error.h"
#include "engine/files/output_file.h"
#include "engine/image/image_io.h"
#include "samples/host/measures/shot_files.h"
#include "samples/lensgraph/bench/names.h"
#include "samples/lensgraph/version.h"

namespace lensgraph::cli {
namespace {

using nlohmann::json;
using std::filesystem::path;

/// Views an execution adds: as many as the curve's first point has.
constexpr int kViewsPerExecution = kFirstCurveSamples;

std::vector<int> curveSamples() {
  std::vector<int> samples;
  for (int views = kFirstCurveSamples; views <= kLastCurveSamples; views *= 2) samples.push_back(views);
  return samples;
}

path placeOf(const host::Shot& shot, int samples, const std::string& caseId, const std::string& device,
             const path& folder) {
  const std::string content = device + host::hashOfFiles(host::filesOf(shot)) + std::to_string(shot.width) + "x" +
                              std::to_string(shot.height) + std::string(host::nameOf(shot.faces)) +
                              std::to_string(samples);
  return folder / (fileNameOf(caseId) + "_" + host::hashOfText(content));
}

path pictureFile(const path& place, int samples) {
  return place / ("views_" + std::to_string(samples) + ".exr");
}

/// Written last: where it stands, all pictures do.
path completionFile(const path& place) {
  return place / "complete.json";
}

void render(host::Renderer& renderer, const host::Shot& shot, int samples, const path& place,
            const std::function<void(double)>& progress) {
  std::filesystem::create_directories(place);
  host::RenderOptions options;
  options.technique = "accumulation";
  options.parameters = {{"lensSamples", int64_t{samples}}, {"viewsPerFrame", int64_t{kViewsPerExecution}}};
  options.progress = [&](uint32_t done, uint32_t total) { progress(static_cast<double>(done) / total); };
  for (const int views : curveSamples()) {
    options.intermediateAt.push_back(static_cast<uint32_t>(views / kViewsPerExecution));
  }
  options.intermediate = [&](uint32_t executions, const engine::FloatImage& color) {
    engine::writeImage(pictureFile(place, static_cast<int>(executions) * kViewsPerExecution), color);
  };
  const auto rendering = renderer.render(shot, options);
  engine::writeImage(pictureFile(place, samples), rendering.color);
  engine::writeFile(completionFile(place), json{{"samples", samples}, {"commit", kCommit}}.dump(2) + "\n");
}

/// The pictures of a place; none where they are missing, unfinished or damaged.
std::optional<AccumulationPictures> read(const path& place, int samples) {
  if (!std::filesystem::exists(completionFile(place))) return {};
  try {
    AccumulationPictures pictures;
    for (const int views : curveSamples()) {
      pictures.curve.push_back({views, engine::readImage(pictureFile(place, views))});
    }
    pictures.reference = engine::readImage(pictureFile(place, samples));
    std::ifstream stream(completionFile(place));
    const auto facts = json::parse(stream, nullptr, false);
    if (facts.is_object()) pictures.commit = facts.value("commit", "");
    return pictures;
  } catch (const engine::Error& error) {
    spdlog::warn("{}; rendering it again", error.what());
    return {};
  }
}

}  // namespace

AccumulationPictures accumulationPictures(host::Renderer& renderer, const host::Shot& shot, int samples,
                                          const std::string& caseId, const std::string& device, const path& folder,
                                          const std::function<void(double)>& progress) {
  const path place = placeOf(shot, samples, caseId, device, folder);
  if (auto kept = read(place, samples)) return std::move(*kept);
  render(renderer, shot, samples, place, progress);
  if (auto made = read(place, samples)) return std::move(*made);
  throw engine::Error(place.string() + ": the pictures cannot be read again", engine::ErrorKind::failed);
}

}  // namespace lensgraph::cli
