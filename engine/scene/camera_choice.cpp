// Looks a camera up and checks what the file says of it. Every message names cameras by index and name.
#include "engine/scene/camera_choice.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <string_view>

#include "engine/error.h"

namespace lensgraph::engine {
namespace {

constexpr double kPi = 3.14159265358979323846;

// Lengths of what a message quotes, in bytes: an error line has at most 500, its file's name included.
constexpr std::size_t kNameLength = 40;
constexpr std::size_t kListLength = 160;

std::string fieldOf(const CameraChoice& choice) {
  return std::holds_alternative<OnlyCamera>(choice) ? "camera" : "camera.gltfCamera";
}

[[noreturn]] void fail(const CameraChoice& choice, const std::string& reason, const std::string& remedy = {}) {
  throw Error(ErrorParts{.file = {}, .field = fieldOf(choice), .reason = reason, .remedy = remedy});
}

/// "2 'Ortho'", or "2" when it has no name.
std::string shown(const Scene& scene, std::size_t index) {
  const std::string& name = scene.cameras[index].name;
  return std::to_string(index) + (name.empty() ? "" : " '" + asLine(name, kNameLength) + "'");
}

/// "0 'A', 1 'B' (orthographic) and 12 more".
std::string allCameras(const Scene& scene) {
  std::string list;
  for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
    std::string next = (i == 0 ? "" : ", ") + shown(scene, i);
    if (scene.cameras[i].type == CameraType::orthographic) next += " (orthographic)";
    if (list.size() + next.size() > kListLength) {
      return list + " and " + std::to_string(scene.cameras.size() - i) + " more";
    }
    list += next;
  }
  return list;
}

[[noreturn]] void failUnknown(const Scene& scene, const CameraChoice& choice, const std::string& wanted) {
  fail(choice, "there is no camera " + wanted + " in the scene",
       scene.cameras.empty() ? "the scene has no cameras" : "it has " + allCameras(scene));
}

[[noreturn]] void failOnly(const Scene& scene, const CameraChoice& choice) {
  if (scene.cameras.empty()) {
    fail(choice, "the scene has no camera of its own", "write \"position\", \"target\" and \"fovyDeg\"");
  }
  fail(choice, "the scene has " + std::to_string(scene.cameras.size()) + " cameras",
       "choose one with \"gltfCamera\", its number or name: " + allCameras(scene));
}

/// The number that a text of digits alone is; nothing for other texts and for numbers beyond every index.
std::optional<std::size_t> numberIn(std::string_view text) {
  std::size_t index = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), index);
  if (code != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return index;
}

std::size_t indexOfName(const Scene& scene, const CameraChoice& choice, const std::string& name) {
  if (const SceneCamera* found = findCamera(scene, name)) return static_cast<std::size_t>(found - scene.cameras.data());
  const auto index = numberIn(name);
  if (index && *index < scene.cameras.size()) return *index;
  failUnknown(scene, choice, "'" + asLine(name, kNameLength) + "'");
}

std::size_t indexOf(const Scene& scene, const CameraChoice& choice) {
  if (const auto* name = std::get_if<std::string>(&choice)) return indexOfName(scene, choice, *name);
  if (const auto* index = std::get_if<std::size_t>(&choice)) {
    if (*index >= scene.cameras.size()) failUnknown(scene, choice, std::to_string(*index));
    return *index;
  }
  if (scene.cameras.size() != 1) failOnly(scene, choice);
  return 0;
}

/// "camera 1 'A' has yfov 0 in the file's cameras[3].perspective, must be …".
[[noreturn]] void failValue(const CameraChoice& choice, const std::string& camera, const SceneCamera& source,
                            const char* member, double value, const char* requirement) {
  char number[32];
  std::snprintf(number, sizeof number, "%g", value);
  fail(choice, camera + " has " + member + " " + number + " (cameras[" + std::to_string(source.fileIndex) +
                   "].perspective of its file), must be " + requirement);
}

}  // namespace

Camera cameraFromScene(const Scene& scene, const CameraChoice& choice, std::optional<double> nearPlane) {
  const std::size_t index = indexOf(scene, choice);
  const SceneCamera& source = scene.cameras[index];
  const std::string name = "camera " + shown(scene, index);
  if (source.type == CameraType::orthographic) {
    fail(choice, name + " is orthographic: only perspective cameras are rendered");
  }
  if (!(source.yfov > 0.0 && source.yfov < kPi)) {
    failValue(choice, name, source, "yfov", source.yfov, "above 0 and below pi");
  }
  if (!nearPlane && !(source.znear > 0.0 && std::isfinite(source.znear))) {
    failValue(choice, name, source, "znear", source.znear, "above 0");
  }
  Camera camera;
  camera.viewFromWorld = viewFromCameraMatrix(source.worldFromCamera, fieldOf(choice));
  camera.fovy = source.yfov;
  camera.nearPlane = nearPlane.value_or(source.znear);
  return camera;
}

}  // namespace lensgraph::engine
