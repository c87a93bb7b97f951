// Warnings about pictures that may not be what was meant: see warnings.h.
#include "samples/host/warnings.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>
#include <limits>

namespace lensgraph::host {
namespace {

std::string text(double number) {
  char digits[32];
  std::snprintf(digits, sizeof digits, "%.3g", number);
  return digits;
}

/// "a", "a and b", "a, b and c".
std::string enumeration(const std::vector<std::string>& names) {
  std::string all;
  for (std::size_t i = 0; i < names.size(); ++i) {
    all += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  }
  return all;
}

/// View depths that the corners of the instances' boxes span, m.
struct DepthRange {
  double nearest = std::numeric_limits<double>::infinity(), farthest = -std::numeric_limits<double>::infinity();
};

DepthRange depthsOfBoxes(const engine::Scene& scene, const engine::Camera& camera, double metersPerUnit) {
  DepthRange range;
  for (const engine::Instance& instance : scene.instances) {
    const engine::Bounds& box = scene.primitives[instance.primitive].bounds;
    if (box.isEmpty()) continue;
    const glm::dmat4 viewFromObject = camera.viewFromWorld * instance.worldFromObject;
    for (int corner = 0; corner < 8; ++corner) {
      const glm::dvec4 point((corner & 1) != 0 ? box.max.x : box.min.x, (corner & 2) != 0 ? box.max.y : box.min.y,
                             (corner & 4) != 0 ? box.max.z : box.min.z, 1.0);
      const double depth = -(viewFromObject * point).z * metersPerUnit;
      range.nearest = std::min(range.nearest, depth);
      range.farthest = std::max(range.farthest, depth);
    }
  }
  return range;
}

bool shines(const engine::Material& material) {
  return material.unlit || (material.emissiveFactor != glm::vec3(0.0f) && material.emissiveStrength != 0.0f);
}

}  // namespace

std::optional<std::string> ignoredLensWarning(const passes::Lens& lens, const passes::Technique& technique) {
  if (passes::apertureRadius(lens) == 0.0) return std::nullopt;
  std::vector<std::string> ignored, sizeOnly;
  for (const auto field : passes::shapingFields(lens)) {
    const auto isIn = [&](const auto& list) { return std::ranges::find(list, field) != list.end(); };
    if (isIn(technique.ignoredLensFields)) ignored.push_back("lens." + std::string(field));
    if (isIn(technique.sizeOnlyLensFields)) sizeOnly.push_back("lens." + std::string(field));
  }
  std::string line;
  if (!ignored.empty()) line = " ignores " + enumeration(ignored);
  if (!sizeOnly.empty()) {
    line += (line.empty() ? "" : ", and") + std::string(" lets only the blur's size follow ") + enumeration(sizeOnly);
  }
  if (line.empty()) return std::nullopt;
  return std::string(technique.name) + line;
}

std::string invisibleSceneWarning(const engine::Scene& scene, const engine::Camera& camera, double metersPerUnit) {
  const DepthRange range = depthsOfBoxes(scene, camera, metersPerUnit);
  if (range.farthest < range.nearest) return "the scene has nothing to draw: the picture is the background alone";
  if (range.farthest <= 0.0) return "the whole scene is behind the camera: the picture is the background alone";
  if (range.farthest <= camera.nearPlane) {
    return "nothing is beyond the near plane of " + text(camera.nearPlane) + " m: the scene ends at " +
           text(range.farthest) + " m; set camera.near to " +
           text(std::max(range.nearest, range.farthest * 0.1) * 0.5) +
           ", for example; the picture is the background alone";
  }
  return "nothing of the scene is in the picture, only the background: check the camera";
}

std::optional<std::string> backFacesWarning(const engine::FloatImage& color, const std::array<float, 3>& background,
                                            const engine::Scene& scene) {
  if (std::ranges::all_of(scene.materials, &engine::Material::doubleSided)) return std::nullopt;
  for (std::size_t i = 0; i < color.pixelCount(); ++i) {
    if (!std::equal(background.begin(), background.end(), color.samples.data() + i * color.channels)) {
      return std::nullopt;
    }
  }
  return "the picture is the background alone: what is in view is seen from behind, perhaps; with faces \"both\" back "
         "faces "
         "of single-sided materials are drawn too";
}

std::optional<std::string> unlitSceneWarning(const engine::Scene& scene, bool hasEnvironment) {
  if (hasEnvironment || !scene.lights.empty()) return std::nullopt;
  const bool isSeen = std::ranges::any_of(scene.instances, [&](const engine::Instance& instance) {
    return shines(scene.materials[scene.primitives[instance.primitive].material]);
  });
  if (isSeen) return std::nullopt;
  return "shading is lit, but the scene has no lights and the shot no environment: every surface is black; name an "
         "environment, or set shading to unlit";
}

std::optional<std::string> listRoomWarning(const shared::FrameStatistics& statistics) {
  if (statistics.fragmentNodesDropped == 0) return std::nullopt;
  return "lists had no room for " + std::to_string(statistics.fragmentNodesDropped) + " of " +
         std::to_string(statistics.fragmentNodes) +
         " fragments: some that lie farthest behind others are missing; a smaller picture has room";
}

std::optional<std::string> limitedBlurWarning(uint32_t limitedPixels, const passes::Lens& lens,
                                              const passes::Technique& technique,
                                              const passes::ParameterSet& parameters, int imageHeight) {
  if (limitedPixels == 0) return std::nullopt;
  std::string limit = "lens.maxCocRadius (" + text(lens.maxCocRadius) + " of the picture's height)";
  for (const passes::ParameterInfo& info : technique.parameters) {
    if (info.name != technique.blurLimit) continue;
    const auto given = parameters.find(std::string(info.name));
    const double pixels = std::get<double>(given == parameters.end() ? info.defaultValue : given->second);
    if (lens.maxCocRadius > 0.0 && lens.maxCocRadius * imageHeight < pixels) continue;
    limit = std::string(info.name) + " (" + text(pixels) + " px)";
  }
  return limit + " limited the blur of " + std::to_string(limitedPixels) + " pixels";
}

std::optional<std::string> clippedPictureWarning(const engine::FloatImage& color, double exposureEv) {
  if (color.isEmpty()) return std::nullopt;
  const auto colors = std::min<uint32_t>(color.channels, 3);
  std::vector<float> brightest(color.pixelCount());
  for (std::size_t i = 0; i < brightest.size(); ++i) {
    const float* pixel = color.samples.data() + i * color.channels;
    brightest[i] = *std::max_element(pixel, pixel + colors);
    if (!std::isfinite(brightest[i])) brightest[i] = std::numeric_limits<float>::max();
  }
  // Half a step of 8 bits above white is still white.
  const auto limit = static_cast<float>(std::exp2(-exposureEv) * 1.004);
  const auto clipped = static_cast<std::size_t>(std::ranges::count_if(brightest, [&](float v) { return v > limit; }));
  if (2 * clipped <= brightest.size()) return std::nullopt;
  const auto rank = static_cast<std::ptrdiff_t>(brightest.size() - 1 - brightest.size() / 100);
  std::nth_element(brightest.begin(), brightest.begin() + rank, brightest.end());
  // Rounded down to tenths, so that trying it helps.
  const double fitting =
      std::floor(-10.0 * std::log2(static_cast<double>(brightest[static_cast<std::size_t>(rank)]))) / 10.0;
  char line[160];
  std::snprintf(line, sizeof line, "%.0f %% of the pixels are brighter than the file can show; try --exposure %.1f",
                100.0 * static_cast<double>(clipped) / static_cast<double>(brightest.size()), fitting);
  return line;
}

}  // namespace lensgraph::host
