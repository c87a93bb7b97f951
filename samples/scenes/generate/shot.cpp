// Shot files and their measures; see shot.h. The blur radius is c = S E (1/d_f − 1/d), S = h / (2 tan(fovy /
// 2)).
#include "generate/shot.h"

#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <stdexcept>
#include <vector>

namespace scenes {
namespace {

constexpr int kWidth = 640;
constexpr int kHeight = 360;
constexpr double kNearPlane = 0.01;  // m, the renderer's default.

using Polygon = std::vector<glm::vec3>;

/// The part of a polygon where dot(plane, point) ≥ offset.
Polygon clip(const Polygon& polygon, glm::vec3 plane, float offset) {
  Polygon inside;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const glm::vec3 a = polygon[i];
    const glm::vec3 b = polygon[(i + 1) % polygon.size()];
    const float da = glm::dot(plane, a) - offset;
    const float db = glm::dot(plane, b) - offset;
    if (da >= 0.0f) inside.push_back(a);
    if ((da < 0.0f) != (db < 0.0f)) inside.push_back(a + (b - a) * (da / (da - db)));
  }
  return inside;
}

Json toJson(glm::vec3 value) {
  const auto exact = [](float component) { return std::round(static_cast<double>(component) * 1e6) / 1e6; };
  return {exact(value.x), exact(value.y), exact(value.z)};
}

}  // namespace

Extent measure(const Shot& shot, const Glb& scene) {
  const glm::vec3 forward = glm::normalize(shot.camera.target - shot.camera.position);
  const glm::vec3 right = glm::normalize(glm::cross(forward, glm::vec3(0, 1, 0)));
  const glm::vec3 up = glm::cross(right, forward);
  const float tangentY = std::tan(glm::radians(shot.camera.fovyDeg) * 0.5f);
  const float tangentX = tangentY * static_cast<float>(kWidth) / static_cast<float>(kHeight);

  double nearest = std::numeric_limits<double>::infinity();
  double farthest = 0.0;
  for (const Glb::Triangle& triangle : scene.worldTriangles()) {
    Polygon polygon;
    for (const glm::vec3 corner : triangle) {
      const glm::vec3 offset = corner - shot.camera.position;
      polygon.emplace_back(glm::dot(offset, right), glm::dot(offset, up), glm::dot(offset, forward));
    }
    polygon = clip(polygon, {0, 0, 1}, static_cast<float>(kNearPlane));
    for (const float sign : {-1.0f, 1.0f}) {
      polygon = clip(polygon, {sign, 0, tangentX}, 0.0f);
      polygon = clip(polygon, {0, sign, tangentY}, 0.0f);
    }
    for (const glm::vec3 corner : polygon) {
      nearest = std::min(nearest, static_cast<double>(corner.z));
      farthest = std::max(farthest, static_cast<double>(corner.z));
    }
  }
  const double cocScale = kHeight / (2.0 * static_cast<double>(tangentY)) * shot.lens.radius();
  const double focusVergence = 1.0 / shot.lens.focusDistance;
  return {nearest, farthest, cocScale * (focusVergence - 1.0 / nearest), cocScale * (focusVergence - 1.0 / farthest),
          cocScale * focusVergence};
}

void writeShot(const std::filesystem::path& file, const Shot& shot, const std::string& sceneFile) {
  Json json = {{"name", shot.name}, {"description", shot.description}, {"scene", Json::array({{{"path", sceneFile}}})}};
  if (shot.camera.gltfName.empty()) {
    json["camera"] = {{"position", toJson(shot.camera.position)},
                      {"target", toJson(shot.camera.target)},
                      {"up", {0, 1, 0}},
                      {"fovyDeg", shot.camera.fovyDeg}};
  } else {
    json["camera"] = {{"gltfCamera", shot.camera.gltfName}};
  }
  if (shot.lens.focalLengthMm) {
    json["lens"] = {{"focalLengthMm", *shot.lens.focalLengthMm}, {"fStop", shot.lens.fStop}};
  } else {
    json["lens"] = {{"apertureRadius", shot.lens.apertureRadius}};
  }
  json["lens"]["focusDistance"] = shot.lens.focusDistance;
  json["resolution"] = {kWidth, kHeight};
  json["background"] = shot.background;
  if (!shot.environment.empty()) json["environment"] = shot.environment;
  json["shading"] = shot.lit ? "lit" : "unlit";
  std::ofstream stream(file);
  stream << json.dump(1) << '\n';
  stream.close();
  if (!stream) throw std::runtime_error(file.string() + ": cannot be written");
}

}  // namespace scenes
