// Reads shot files: see shot.h. Field by field in the order of a shot; the ranges of lens fields are
// those of passes/lens/physical_lens.h.
#include "samples/host/shot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <nlohmann/json.hpp>

#include "engine/error.h"
#include "samples/host/json_reader.h"
#include "samples/host/technique_choice.h"

namespace lensgraph::host {
namespace {

using std::filesystem::path;

/// A file that a shot names: relative to the shot's folder, and there.
path existingFile(const JsonNode& node, const path& folder) {
  const std::string text = node.text();
  if (text.empty()) node.fail("is empty", "name a file");
  const path file = (folder / text).lexically_normal();
  std::error_code code;
  const auto status = std::filesystem::status(file, code);
  if (!std::filesystem::exists(status)) {
    node.fail("no such file: " + file.string(), "paths are relative to the shot file's folder");
  }
  if (!std::filesystem::is_regular_file(status)) node.fail("is not a file: " + file.string());
  return file;
}

/// A unit quaternion x, y, z, w.
glm::dvec4 parseRotation(const JsonNode& node) {
  const auto parts = node.elements(4, "a quaternion [x, y, z, w]");
  const double x = parts[0].number(), y = parts[1].number(), z = parts[2].number(), w = parts[3].number();
  // Scaled by the largest part first: squares of tiny or huge numbers would leave the range of double.
  const double largest = std::max({std::abs(x), std::abs(y), std::abs(z), std::abs(w)});
  if (largest == 0.0) node.fail("is a zero quaternion", "no rotation is [0, 0, 0, 1]");
  const auto unit = glm::normalize(glm::dquat(w / largest, x / largest, y / largest, z / largest));
  return {unit.x, unit.y, unit.z, unit.w};
}

ScenePart parsePart(const JsonNode& node, const path& folder) {
  node.requireObject({"path", "translation", "rotation", "scale"});
  ScenePart part;
  part.path = existingFile(node.at("path", "name a .gltf or .glb file"), folder);
  if (const auto translation = node.find("translation")) part.transform.translation = translation->vector("[x, y, z]");
  if (const auto rotation = node.find("rotation")) part.transform.rotation = parseRotation(*rotation);
  if (const auto scale = node.find("scale")) {
    const glm::dvec3 factors = scale->vector("[x, y, z]");
    part.transform.scale = factors;
    if (factors.x == 0.0 || factors.y == 0.0 || factors.z == 0.0) {
      scale->fail("has a zero", "a scene scaled by 0 cannot be seen; leave it out of the shot instead");
    }
  }
  return part;
}

void parseLookAt(const JsonNode& node, ShotCamera& camera) {
  camera.position = node.at("position", "write [x, y, z], or \"gltfCamera\": name").vector("[x, y, z]");
  camera.target = node.at("target", "write [x, y, z], a point to look at").vector("[x, y, z]");
  if (const auto up = node.find("up")) camera.up = up->vector("[x, y, z]");
  camera.fovyDeg = node.at("fovyDeg", "write the vertical field of view in degrees").number();
  if (const auto problem = engine::findProblem(camera)) node.failAt(problem->field, problem->reason, problem->remedy);
}

engine::CameraChoice parseGltfCamera(const JsonNode& node) {
  if (!node.isString()) {
    if (!node.json().is_number()) node.fail("is " + std::string(node.typeName()) + ", must be a number or a string");
    return static_cast<std::size_t>(node.integer(0, std::numeric_limits<uint32_t>::max()));
  }
  std::string name = node.text();
  if (name.empty()) node.fail("is empty", "name a camera of the scene, or give its number");
  return name;
}

ShotCamera parseCamera(const JsonNode& node) {
  node.requireObject({"position", "target", "up", "fovyDeg", "gltfCamera", "near"});
  constexpr std::array kLookAt = {"position", "target", "up", "fovyDeg"};
  const auto given = std::ranges::find_if(kLookAt, [&](const char* name) { return node.has(name); });
  ShotCamera camera;
  if (const auto choice = node.find("gltfCamera")) {
    camera.gltfCamera = parseGltfCamera(*choice);
    if (given != kLookAt.end()) {
      node.failAt(*given, "given beside gltfCamera, which has its own", "remove one of them");
    }
  } else if (given == kLookAt.end()) {
    camera.gltfCamera = engine::OnlyCamera{};
  } else {
    parseLookAt(node, camera);
  }
  if (const auto near = node.find("near")) {
    camera.nearPlane = near->number();
    if (!(*camera.nearPlane > 0.0)) near->fail("is " + near->json().dump() + ", must be above 0 metres");
  }
  return camera;
}

struct LensNumber {
  const char* name;
  double passes::Lens::*member;
};
constexpr LensNumber kLensNumbers[] = {
    {"focalLengthMm", &passes::Lens::focalLengthMm},
    {"fStop", &passes::Lens::fStop},
    {"sensorWidthMm", &passes::Lens::sensorWidthMm},
    {"sensorHeightMm", &passes::Lens::sensorHeightMm},
    {"metersPerUnit", &passes::Lens::metersPerUnit},
    {"bladeRotation", &passes::Lens::bladeRotation},
    {"bladeCurvature", &passes::Lens::bladeCurvature},
    {"anamorphicRatio", &passes::Lens::anamorphicRatio},
    {"opticalVignetting", &passes::Lens::opticalVignetting},
    {"sphericalAberration", &passes::Lens::sphericalAberration},
    {"maxCocRadius", &passes::Lens::maxCocRadius},
};

double parseFocusDistance(const JsonNode& node) {
  const char* remedy = "metres above 0, or \"infinity\"";
  if (node.isString()) {
    if (node.text() != "infinity") node.fail("is \"" + node.text() + "\", must be a number or \"infinity\"", remedy);
    return std::numeric_limits<double>::infinity();
  }
  const double distance = node.number();
  if (!(distance > 0.0)) node.fail("is " + node.json().dump() + ", must be above 0", remedy);
  return distance;
}

/// The aperture is given once: as a radius, or as focal length and f-number. With a radius the focal length
/// still has a meaning where the field of view breathes.
void parseApertureRadius(const JsonNode& lensNode, passes::Lens& lens) {
  const auto radius = lensNode.find("apertureRadius");
  if (!radius) return;
  if (lensNode.has("fStop")) {
    lensNode.failAt("apertureRadius", "given beside fStop, which also sets the aperture", "remove one of them");
  }
  if (lensNode.has("focalLengthMm") && lens.fovModel == passes::FovModel::pinhole) {
    lensNode.failAt("apertureRadius", "given beside focalLengthMm, which has no effect then",
                    "remove one of them, or set fovModel to breathing");
  }
  lens.apertureRadius = radius->number();
  if (!(lens.apertureRadius >= 0.0)) {
    radius->fail("is " + radius->json().dump() + ", must be 0 or more metres", "0 turns depth of field off");
  }
}

/// The lens's complaint with the value that the file gives: "is -2, must be …".
[[noreturn]] void failLens(const JsonNode& lensNode, const passes::LensProblem& problem) {
  const auto value = lensNode.find(problem.field);
  if (!value) lensNode.failAt(problem.field, problem.reason, problem.remedy);
  const char* joint = problem.reason.starts_with("must") ? ", " : ": ";
  value->fail("is " + value->json().dump() + joint + problem.reason, problem.remedy);
}

passes::Lens parseLens(const JsonNode& node) {
  node.requireObject({"apertureRadius", "focalLengthMm", "fStop", "sensorWidthMm", "sensorHeightMm", "focusDistance",
                      "metersPerUnit", "fovModel", "bladeCount", "bladeRotation", "bladeCurvature", "anamorphicRatio",
                      "opticalVignetting", "sphericalAberration", "maxCocRadius"});
  passes::Lens lens;
  for (const auto& [name, member] : kLensNumbers) {
    if (const auto value = node.find(name)) lens.*member = value->number();
  }
  if (const auto blades = node.find("bladeCount")) lens.bladeCount = static_cast<int>(blades->integer(0, 16));
  if (const auto model = node.find("fovModel")) {
    const std::string text = model->text();
    if (text != "pinhole" && text != "breathing") {
      model->fail("is \"" + text + "\", must be \"pinhole\" or \"breathing\"");
    }
    lens.fovModel = text == "breathing" ? passes::FovModel::breathing : passes::FovModel::pinhole;
  }
  lens.focusDistance = parseFocusDistance(node.at("focusDistance", "write metres, or \"infinity\""));
  parseApertureRadius(node, lens);
  const auto problems = passes::validate(lens);
  if (!problems.empty()) failLens(node, problems.front());
  return lens;
}

void parsePicture(const JsonNode& root, const path& folder, Shot& shot) {
  if (const auto resolution = root.find("resolution")) {
    const auto parts = resolution->elements(2, "[width, height] in pixels");
    shot.width = static_cast<int>(parts[0].integer(1, kMaxResolution));
    shot.height = static_cast<int>(parts[1].integer(1, kMaxResolution));
  }
  if (const auto background = root.find("background")) {
    const auto parts = background->elements(3, "[r, g, b], linear radiance");
    for (std::size_t i = 0; i < 3; ++i) {
      shot.background[i] = static_cast<float>(parts[i].number(0.0, std::numeric_limits<float>::max()));
    }
  }
  if (const auto environment = root.find("environment")) shot.environment = existingFile(*environment, folder);
  if (const auto shading = root.find("shading")) {
    const std::string text = shading->text();
    if (text != "unlit" && text != "lit") shading->fail("is \"" + text + "\", must be \"unlit\" or \"lit\"");
    shot.shading = text == "lit" ? Shading::lit : Shading::unlit;
  }
  if (const auto node = root.find("faces")) {
    const auto faces = drawnFacesFrom(node->text());
    if (!faces) node->fail("is \"" + node->text() + "\", must be \"material\" or \"both\"");
    shot.faces = *faces;
  }
}

}  // namespace

std::optional<engine::DrawnFaces> drawnFacesFrom(std::string_view text) {
  for (const auto faces : {engine::DrawnFaces::material, engine::DrawnFaces::both}) {
    if (text == nameOf(faces)) return faces;
  }
  return std::nullopt;
}

std::string_view nameOf(engine::DrawnFaces faces) {
  return faces == engine::DrawnFaces::both ? "both" : "material";
}

Shot readShot(const path& file) {
  const auto document = readJsonFile(file);
  const JsonNode root(document, file);
  root.requireObject({"name", "description", "scene", "camera", "lens", "resolution", "background", "environment",
                      "shading", "faces", "technique"});
  const path folder = file.parent_path();

  Shot shot;
  shot.file = file;
  const auto name = root.find("name");
  shot.name = name ? name->text() : file.stem().string();
  if (const auto description = root.find("description")) description->text();
  for (const auto& part : root.at("scene", "write [{\"path\": \"scene.glb\"}]").elements()) {
    shot.scene.push_back(parsePart(part, folder));
  }
  if (const auto camera = root.find("camera")) {
    shot.camera = parseCamera(*camera);
  } else {
    shot.camera.gltfCamera = engine::OnlyCamera{};
  }
  shot.lens = parseLens(root.at("lens", "write {\"apertureRadius\", \"focusDistance\"}"));
  parsePicture(root, folder, shot);
  if (const auto technique = root.find("technique")) {
    auto choice = parseTechnique(*technique);
    shot.technique = std::move(choice.name);
    shot.parameters = std::move(choice.parameters);
  }
  return shot;
}

}  // namespace lensgraph::host
