// Shot files: what is read from good ones, and what is said of bad ones.
#include "samples/host/shot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

#include "engine/error.h"
#include "files.h"

namespace lensgraph {

namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

class ShotFile : public testing::Test {
 protected:
  ShotFile() { folder_.write("scene.glb", "content is the loader's business"); }

  /// The smallest complete shot.
  static json minimal() {
    return {{"scene", {{{"path", "scene.glb"}}}},
            {"camera", {{"position", {0, 0, 0}}, {"target", {0, 0, -1}}, {"fovyDeg", 40}}},
            {"lens", {{"apertureRadius", 0.03}, {"focusDistance", 2.5}}}};
  }
  static json with(const std::string& pointer, json value) {
    json shot = minimal();
    shot[json::json_pointer(pointer)] = std::move(value);
    return shot;
  }

  host::Shot read(const json& shot) { return host::readShot(folder_.write("shot.json", shot.dump(1))); }

  engine::ErrorParts errorOf(const std::string& text) {
    try {
      host::readShot(folder_.write("shot.json", text));
    } catch (const engine::Error& error) {
      EXPECT_EQ(error.kind(), engine::ErrorKind::badInput);
      EXPECT_THAT(error.parts().file, HasSubstr("shot.json"));
      EXPECT_FALSE(error.parts().reason.empty());
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
      return error.parts();
    }
    ADD_FAILURE() << "was read without complaint: " << text;
    return {};
  }
  engine::ErrorParts errorOf(const json& shot) { return errorOf(shot.dump(1)); }

  TestFolder folder_;
};

TEST_F(ShotFile, TakesDefaultsForWhatIsAbsent) {
  const auto shot = read(minimal());
  EXPECT_EQ(shot.name, "shot");
  EXPECT_EQ(shot.width, 640);
  EXPECT_EQ(shot.height, 360);
  EXPECT_EQ(shot.shading, host::Shading::unlit);
  EXPECT_EQ(shot.technique, "accumulation");
  EXPECT_TRUE(shot.parameters.empty());
  EXPECT_EQ(shot.camera.up, glm::dvec3(0, 1, 0));
  EXPECT_EQ(shot.camera.nearPlane, std::nullopt);
  EXPECT_EQ(shot.camera.gltfCamera, std::nullopt);
  EXPECT_EQ(shot.lens.apertureRadius, 0.03);
  EXPECT_EQ(shot.lens.fovModel, passes::FovModel::pinhole);
  ASSERT_EQ(shot.scene.size(), 1u);
  EXPECT_EQ(shot.scene[0].transform.scale, glm::dvec3(1));
}

TEST_F(ShotFile, ResolvesPathsAgainstItsOwnFolder) {
  EXPECT_EQ(read(minimal()).scene[0].path, folder_.path() / "scene.glb");
}

TEST_F(ShotFile, ReadsPlacement) {
  auto shot = minimal();
  shot["scene"][0]["translation"] = {1, 2, 3};
  shot["scene"][0]["rotation"] = {0, 3, 0, 4};  // x y z w, not of unit length
  shot["scene"][0]["scale"] = {2, -2, 0.5};
  const auto part = read(shot).scene[0];
  EXPECT_EQ(part.transform.translation, glm::dvec3(1, 2, 3));
  EXPECT_DOUBLE_EQ(part.transform.rotation.y, 0.6);
  EXPECT_DOUBLE_EQ(part.transform.rotation.w, 0.8);
  EXPECT_EQ(part.transform.scale, glm::dvec3(2, -2, 0.5));
}

TEST_F(ShotFile, NormalisesQuaternionsOfAnyLength) {
  for (const double length : {1e-300, 1e300}) {
    auto shot = minimal();
    shot["scene"][0]["rotation"] = {length, 0, 0, 0};
    EXPECT_DOUBLE_EQ(read(shot).scene[0].transform.rotation.x, 1.0) << length;
  }
}

TEST_F(ShotFile, ReadsEveryLensField) {
  const auto lens = read(with("/lens", {{"focalLengthMm", 85},
                                        {"fStop", 1.4},
                                        {"sensorWidthMm", 35},
                                        {"sensorHeightMm", 23},
                                        {"focusDistance", 3},
                                        {"metersPerUnit", 0.01},
                                        {"fovModel", "breathing"},
                                        {"bladeCount", 7},
                                        {"bladeRotation", 0.5},
                                        {"bladeCurvature", 0.25},
                                        {"anamorphicRatio", 2},
                                        {"opticalVignetting", 0.75},
                                        {"sphericalAberration", -0.5},
                                        {"maxCocRadius", 0.1}}))
                        .lens;
  EXPECT_EQ(lens.focalLengthMm, 85);
  EXPECT_EQ(lens.fStop, 1.4);
  EXPECT_LT(lens.apertureRadius, 0.0) << "not given";
  EXPECT_EQ(lens.sensorWidthMm, 35);
  EXPECT_EQ(lens.sensorHeightMm, 23);
  EXPECT_EQ(lens.focusDistance, 3);
  EXPECT_EQ(lens.metersPerUnit, 0.01);
  EXPECT_EQ(lens.fovModel, passes::FovModel::breathing);
  EXPECT_EQ(lens.bladeCount, 7);
  EXPECT_EQ(lens.bladeRotation, 0.5);
  EXPECT_EQ(lens.bladeCurvature, 0.25);
  EXPECT_EQ(lens.anamorphicRatio, 2);
  EXPECT_EQ(lens.opticalVignetting, 0.75);
  EXPECT_EQ(lens.sphericalAberration, -0.5);
  EXPECT_EQ(lens.maxCocRadius, 0.1);
}

TEST_F(ShotFile, FocusesAtInfinityByName) {
  EXPECT_TRUE(std::isinf(read(with("/lens/focusDistance", "infinity")).lens.focusDistance));
}

TEST_F(ShotFile, ZeroFStopAndZeroRadiusAreLegal) {
  EXPECT_EQ(read(with("/lens", {{"fStop", 0}, {"focusDistance", 2}})).lens.fStop, 0.0);
  EXPECT_EQ(read(with("/lens/apertureRadius", 0)).lens.apertureRadius, 0.0);
}

TEST_F(ShotFile, ReadsCameraOfTheScene) {
  const auto shot = read(with("/camera", {{"gltfCamera", "front"}, {"near", 0.1}}));
  EXPECT_EQ(shot.camera.gltfCamera, engine::CameraChoice("front"));
  EXPECT_EQ(shot.camera.nearPlane, 0.1);
}

TEST_F(ShotFile, ReadsTheNumberOfACameraOfTheScene) {
  for (const json& number : {json(2), json(2.0)}) {
    EXPECT_EQ(read(with("/camera", {{"gltfCamera", number}})).camera.gltfCamera, engine::CameraChoice(std::size_t{2}));
  }
  EXPECT_EQ(read(with("/camera", {{"gltfCamera", "2"}})).camera.gltfCamera, engine::CameraChoice("2"));
}

TEST_F(ShotFile, WithoutACameraTakesTheOnlyOneOfTheScene) {
  auto bare = minimal();
  bare.erase("camera");
  for (const json& shot : {bare, with("/camera", json::object()), with("/camera", {{"near", 0.5}})}) {
    EXPECT_EQ(read(shot).camera.gltfCamera, engine::CameraChoice(engine::OnlyCamera{}));
  }
  EXPECT_EQ(read(with("/camera", {{"near", 0.5}})).camera.nearPlane, 0.5);
  EXPECT_EQ(read(bare).camera.nearPlane, std::nullopt);
}

TEST_F(ShotFile, ReadsFaces) {
  EXPECT_EQ(read(minimal()).faces, engine::DrawnFaces::material);
  EXPECT_EQ(read(with("/faces", "material")).faces, engine::DrawnFaces::material);
  EXPECT_EQ(read(with("/faces", "both")).faces, engine::DrawnFaces::both);
}

TEST_F(ShotFile, ReadsPictureAndTechnique) {
  auto given = minimal();
  given["name"] = "a name";
  given["resolution"] = {16384, 1};
  given["background"] = {0.5, 0, 2};
  given["shading"] = "lit";
  given["technique"] = {{"name", "two_pass_filter"}};
  const auto shot = read(given);
  EXPECT_EQ(shot.name, "a name");
  EXPECT_EQ(shot.width, 16384);
  EXPECT_EQ(shot.height, 1);
  EXPECT_EQ(shot.background, (std::array{0.5f, 0.0f, 2.0f}));
  EXPECT_EQ(shot.shading, host::Shading::lit);
  EXPECT_EQ(shot.technique, "two_pass_filter");
}

TEST_F(ShotFile, TellsLineAndColumnOfMalformedJson) {
  const auto error = errorOf(std::string("{\n  \"scene\": [],\n  \"camera\" {}\n}"));
  EXPECT_EQ(error.field, "line 3, column 12");
}

TEST_F(ShotFile, TellsWhereATruncatedFileEnds) {
  EXPECT_EQ(errorOf(std::string("{\n \"scene\": [")).field, "line 2, column 12");
}

TEST_F(ShotFile, TellsWhereANumberOverflows) {
  const auto error = errorOf(std::string("{\n \"resolution\": [1e999, 2]}"));
  EXPECT_EQ(error.field, "line 2, column 17");
  EXPECT_THAT(error.reason, HasSubstr("1e999"));
}

TEST_F(ShotFile, RefusesAFieldGivenTwice) {
  const auto error = errorOf(std::string(R"({"scene": [], "scene": []})"));
  EXPECT_EQ(error.field, "scene");
  EXPECT_THAT(error.reason, HasSubstr("twice"));
}

TEST_F(ShotFile, TellsThePathOfAFieldGivenTwice) {
  EXPECT_EQ(errorOf(std::string(R"({"camera": {"up": [0, 1, 0], "position": [], "position": []}})")).field,
            "camera.position");
  EXPECT_EQ(errorOf(std::string(R"({"a": [{}, [1, {}], {"path": {}, "x": {"y": 1}, "path": 1}]})")).field, "a[2].path");
  EXPECT_EQ(errorOf(std::string(R"([[], [], {"a": 1, "a": 2}])")).field, "[2].a");
}

TEST_F(ShotFile, ErrorsAreShortHoweverLongTheirCauseIs) {
  const std::string text(100000, 'x');
  const auto lengthOf = [&](const std::string& shot) {
    return std::string_view(engine::Error(errorOf(shot)).what()).size();
  };
  for (const auto& shot : {with("/shading", text), with("/faces", text), with("/" + text, 1), with("/lens/" + text, 1),
                           with("/scene/0/path", text), with("/technique", {{"name", text}}),
                           with("/technique", {{"name", "pinhole"}, {text, 1}})}) {
    EXPECT_LE(lengthOf(shot.dump()), engine::kLongestLine);
  }
  EXPECT_LE(lengthOf("{\"" + text + "\n\": 1}"), engine::kLongestLine) << "a control character";
  EXPECT_LE(lengthOf("{\"" + text + "\": 1, \"" + text + "\": 1}"), engine::kLongestLine) << "a field given twice";
  EXPECT_LE(lengthOf("{\"a\": 1" + std::string(100000, '0') + "}"), engine::kLongestLine) << "a number that overflows";
}

TEST_F(ShotFile, RefusesFilesThatAreNone) {
  EXPECT_THAT(errorOf(std::string()).reason, HasSubstr("empty"));
  EXPECT_THROW(host::readShot(folder_.path() / "absent.json"), engine::Error);
  EXPECT_THROW(host::readShot(folder_.path()), engine::Error);
  EXPECT_THAT(errorOf(json::array({1})).reason, HasSubstr("object"));
}

TEST_F(ShotFile, SuggestsTheNearestKnownField) {
  const auto error = errorOf(with("/lens/focusDistanse", 2));
  EXPECT_EQ(error.field, "lens.focusDistanse");
  EXPECT_THAT(error.remedy, HasSubstr("focusDistance"));
}

TEST_F(ShotFile, NamesAMissingSceneFile) {
  auto shot = minimal();
  shot["scene"].push_back({{"path", "models/absent.glb"}});
  const auto error = errorOf(shot);
  EXPECT_EQ(error.field, "scene[1].path");
  EXPECT_THAT(error.reason, HasSubstr("models/absent.glb"));
  EXPECT_THAT(error.remedy, HasSubstr("relative"));
}

TEST_F(ShotFile, NamesMissingFields) {
  for (const std::string field : {"scene", "lens"}) {
    auto shot = minimal();
    shot.erase(field);
    EXPECT_EQ(errorOf(shot).field, field);
  }
  for (const std::string field : {"position", "target", "fovyDeg"}) {
    auto shot = minimal();
    shot["camera"].erase(field);
    EXPECT_EQ(errorOf(shot).field, "camera." + field);
  }
}

TEST_F(ShotFile, SuggestsTechniquesAndParameters) {
  const auto technique = errorOf(with("/technique", {{"name", "two_pas_filter"}}));
  EXPECT_EQ(technique.field, "technique.name");
  EXPECT_THAT(technique.remedy, HasSubstr("two_pass_filter"));
  const auto parameter = errorOf(with("/technique", {{"name", "two_pass_filter"}, {"nonsense", 1}}));
  EXPECT_EQ(parameter.field, "technique.nonsense");
}

struct BadField {
  const char* pointer;  ///< Where the value is put …
  const char* value;
  const char* field;  ///< … and the field that must be named.
};
class BadShotField : public ShotFile, public testing::WithParamInterface<BadField> {};

TEST_P(BadShotField, IsNamed) {
  const auto& [pointer, value, field] = GetParam();
  EXPECT_EQ(errorOf(with(pointer, json::parse(value))).field, field);
}

constexpr BadField kBadFields[] = {
    {"/resolution", "[0, 360]", "resolution[0]"},
    {"/resolution", "[640, 0]", "resolution[1]"},
    {"/resolution", "[20000, 360]", "resolution[0]"},
    {"/resolution", "[640, 16385]", "resolution[1]"},
    {"/resolution", "[-640, 360]", "resolution[0]"},
    {"/resolution", "[640.5, 360]", "resolution[0]"},
    {"/resolution", "[640]", "resolution"},
    {"/resolution", "\"640x360\"", "resolution"},
    {"/resolution", "[640, null]", "resolution[1]"},
    {"/lens/focusDistance", "0", "lens.focusDistance"},
    {"/lens/focusDistance", "-1", "lens.focusDistance"},
    {"/lens/focusDistance", "\"far\"", "lens.focusDistance"},
    {"/lens/focusDistance", "null", "lens.focusDistance"},
    {"/lens/apertureRadius", "-0.1", "lens.apertureRadius"},
    {"/lens/fStop", "2.8", "lens.apertureRadius"},
    {"/lens/focalLengthMm", "50", "lens.apertureRadius"},
    {"/lens", R"({"fStop": -2, "focusDistance": 1})", "lens.fStop"},
    {"/lens", R"({"fStop": "fast", "focusDistance": 1})", "lens.fStop"},
    {"/lens", R"({"focalLengthMm": 0, "focusDistance": 1})", "lens.focalLengthMm"},
    {"/lens", R"({"focalLengthMm": 85})", "lens.focusDistance"},
    {"/lens", R"({"fovModel": "breathing", "focalLengthMm": 85, "focusDistance": 0.08})", "lens.focusDistance"},
    {"/lens/fovModel", "\"pinhol\"", "lens.fovModel"},
    {"/lens/bladeCount", "2", "lens.bladeCount"},
    {"/lens/bladeCount", "17", "lens.bladeCount"},
    {"/lens/bladeCount", "5.5", "lens.bladeCount"},
    {"/lens/bladeCurvature", "1.5", "lens.bladeCurvature"},
    {"/lens/anamorphicRatio", "0", "lens.anamorphicRatio"},
    {"/lens/opticalVignetting", "-0.1", "lens.opticalVignetting"},
    {"/lens/sphericalAberration", "2", "lens.sphericalAberration"},
    {"/lens/metersPerUnit", "0", "lens.metersPerUnit"},
    {"/lens/sensorHeightMm", "-24", "lens.sensorHeightMm"},
    {"/lens/maxCocRadius", "-1", "lens.maxCocRadius"},
    {"/camera/fovyDeg", "0", "camera.fovyDeg"},
    {"/camera/fovyDeg", "180", "camera.fovyDeg"},
    {"/camera/target", "[0, 0, 0]", "camera.target"},
    {"/camera/up", "[0, 0, 0]", "camera.up"},
    {"/camera/up", "[0, 0, 5]", "camera.up"},
    {"/camera/position", "[0, 0]", "camera.position"},
    {"/camera/position", "[0, \"x\", 0]", "camera.position[1]"},
    {"/camera/near", "0", "camera.near"},
    {"/camera/gltfCamera", "\"front\"", "camera.position"},
    {"/camera", R"({"gltfCamera": ""})", "camera.gltfCamera"},
    {"/camera", R"({"gltfCamera": -1})", "camera.gltfCamera"},
    {"/camera", R"({"gltfCamera": 0.5})", "camera.gltfCamera"},
    {"/camera", R"({"gltfCamera": 1e300})", "camera.gltfCamera"},
    {"/camera", R"({"gltfCamera": null})", "camera.gltfCamera"},
    {"/camera", R"({"gltfCamera": [0]})", "camera.gltfCamera"},
    {"/camera", R"({"target": [0, 0, 0]})", "camera.position"},
    {"/camera", R"({"fovyDeg": 40})", "camera.position"},
    {"/camera", "null", "camera"},
    {"/camera/position", "[0, 1e300, 0]", "camera.position"},
    {"/faces", "\"front\"", "faces"},
    {"/faces", "true", "faces"},
    {"/scene", "{}", "scene"},
    {"/scene/0/path", "\"\"", "scene[0].path"},
    {"/scene/0/path", "7", "scene[0].path"},
    {"/scene/0/path", "\".\"", "scene[0].path"},
    {"/scene/0/rotation", "[0, 0, 0, 0]", "scene[0].rotation"},
    {"/scene/0/rotation", "[0, 0, 1]", "scene[0].rotation"},
    {"/scene/0/scale", "[1, 0, 1]", "scene[0].scale"},
    {"/scene/0/scale", "2", "scene[0].scale"},
    {"/background", "[0, 0, -1]", "background[2]"},
    {"/background", "[1e39, 0, 0]", "background[0]"},
    {"/environment", "\"absent.exr\"", "environment"},
    {"/shading", "\"shiny\"", "shading"},
    {"/name", "7", "name"},
    {"/technique", "\"pinhole\"", "technique"},
    {"/technique", "{}", "technique.name"},
    {"/technique", R"({"name": "two_pass_filter", "x": [1]})", "technique.x"},
};
INSTANTIATE_TEST_SUITE_P(Each, BadShotField, testing::ValuesIn(kBadFields));

TEST(Shots, ShotsWithRayTracedPicturesAreRead) {
  const std::filesystem::path folder = LENSGRAPH_SHOTS_DIR;
  if (!std::filesystem::is_directory(folder)) GTEST_SKIP() << "no shots";
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const auto file = entry.path() / "shot.json";
    if (!std::filesystem::exists(file)) continue;
    const auto shot = host::readShot(file);
    EXPECT_EQ(shot.name, entry.path().filename().string());
    EXPECT_FALSE(shot.scene.empty());
    ++count;
  }
  EXPECT_GT(count, 0);
}

}  // namespace

}  // namespace lensgraph
