// What a shot says of faces and cameras, and what the command line makes of it; also on files that failed once, where they
// are (skipped where their folder is absent: they are not part of this project).
#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <utility>

#include "engine/image/image.h"
#include "engine/image/image_io.h"
#include "program.h"

namespace lensgraph {

namespace {

using nlohmann::json;
using std::filesystem::path;

/// Beside the folder of the ray-traced shots.
const path kCases = path(LENSGRAPH_SHOTS_DIR).parent_path() / "cases" / "scenes";

json readJson(const path& file) {
  return json::parse(std::ifstream(file));
}

json camera(const std::string& type, const std::string& name, double yfov = 0.7) {
  json made = {{"type", type}};
  if (!name.empty()) made["name"] = name;
  if (type == "perspective") made[type] = {{"yfov", yfov}, {"znear", 0.01}};
  if (type == "orthographic") made[type] = {{"xmag", 1}, {"ymag", 1}, {"znear", 0.01}, {"zfar", 9}};
  return made;
}

constexpr std::pair<float, float> kNothing{0.0f, 0.0f};
constexpr std::pair<float, float> kQuad{0.75f, 0.75f};

class FacesAndCameras : public cli_test::ProgramTest {
 protected:
  FacesAndCameras() {
    writeQuad();
    writeShot(shot());
  }

  /// quad.gltf again, with these cameras, each placed by a node, or with a single-sided material.
  void changeScene(const std::function<void(json&)>& change) const {
    json gltf = readJson(folder() / "quad.gltf");
    change(gltf);
    write("quad.gltf", gltf.dump(1));
  }
  void giveCameras(const json& cameras) const {
    changeScene([&](json& gltf) {
      gltf["cameras"] = cameras;
      for (std::size_t i = 0; i < cameras.size(); ++i) {
        gltf["scenes"][0]["nodes"].push_back(gltf["nodes"].size());
        gltf["nodes"].push_back({{"camera", i}});
      }
    });
  }
  json shotWith(const std::string& pointer, const json& value) const {
    json changed = shot();
    changed[json::json_pointer(pointer)] = value;
    return changed;
  }
  /// A shot whose camera is that, or absent when it is null.
  json shotWithCamera(const json& given) const {
    json changed = shot();
    changed.erase("camera");
    if (!given.is_null()) changed["camera"] = given;
    return changed;
  }

  /// Largest and least blue of the pinhole picture; the quad has 0.75 and the background 0.
  std::pair<float, float> bluesOf(const path& shotFile, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {"render", shotFile.string(), "--technique", "pinhole", "-o", "out.exr"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto outcome = run(arguments);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    const auto picture = engine::readImage(folder() / "out.exr");
    std::pair<float, float> blues(0.0f, 1e30f);
    for (std::size_t i = 0; i < picture.pixelCount(); ++i) {
      const float blue = picture.samples[i * picture.channels + 2];
      blues = {std::max(blues.first, blue), std::min(blues.second, blue)};
    }
    // A picture of nothing is never without a word, and one of the quad has none.
    if (blues == kNothing || blues == kQuad) {
      EXPECT_EQ(outcome.err.empty(), blues == kQuad) << outcome.err;
    }
    return blues;
  }
  std::pair<float, float> bluesOf(const json& given, const std::vector<std::string>& more = {}) const {
    writeShot(given);
    return bluesOf(path("shot.json"), more);
  }

  /// That the shot is refused, with its file, and in a line that is short enough.
  void expectRefused(const json& given, const std::vector<std::string>& parts) const {
    writeShot(given);
    std::vector<std::string> all = parts;
    all.insert(all.begin(), "shot.json: ");
    expectError({"render", "shot.json", "--technique", "pinhole", "-o", "out.exr"}, 2, all);
    EXPECT_LE(run({"render", "shot.json", "--technique", "pinhole", "-o", "out.exr"}).err.size(), 500u);
  }
};

TEST_F(FacesAndCameras, TheBackOfASingleSidedMaterialIsDrawnWhereBothFacesAreAskedFor) {
  json behind = shot();
  behind["camera"] = {{"position", {0, 0, -4}}, {"target", {0, 0, 0}}, {"fovyDeg", 40}};
  EXPECT_EQ(bluesOf(behind), kQuad) << "it is double-sided";
  changeScene([](json& gltf) { gltf["materials"][0].erase("doubleSided"); });
  EXPECT_EQ(bluesOf(shot()), kQuad);
  EXPECT_EQ(bluesOf(behind), kNothing);
  EXPECT_EQ(bluesOf(behind, {"--faces", "both"}), kQuad);
  behind["faces"] = "both";
  EXPECT_EQ(bluesOf(behind), kQuad);
  EXPECT_EQ(bluesOf(behind, {"--faces", "material"}), kNothing);
}

TEST_F(FacesAndCameras, CapturesRecordTheFaces) {
  const auto facesOf = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"render",  "shot.json", "--technique", "pinhole",          "-o",
                                          "out.exr", "--capture", "c.json",      "--capture-frames", "1"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    runWell(arguments);
    return readJson(folder() / "c.json")["faces"];
  };
  EXPECT_EQ(facesOf({}), "material");
  std::filesystem::rename(folder() / "c.json", folder() / "before.json");
  EXPECT_EQ(facesOf({"--faces", "both"}), "both");
  EXPECT_THAT(runWell({"capture-diff", "before.json", "c.json"}), testing::HasSubstr("faces"));
}

TEST_F(FacesAndCameras, FacesThatThereAreNotAreRefused) {
  expectRefused(shotWith("/faces", "front"), {"faces: ", "front", "material", "both"});
  writeShot(shot());
  for (const char* command : {"render", "graph"}) {
    expectError({command, "shot.json", "--faces", "front"}, 2, {"command line", "--faces", "front"});
  }
}

TEST_F(FacesAndCameras, ACameraIsChosenByNumberByNameOrAsTheOnlyOne) {
  giveCameras(json::array({camera("perspective", "")}));
  for (const json& given :
       {json(), json::object(), json{{"near", 0.5}}, json{{"gltfCamera", 0}}, json{{"gltfCamera", "0"}}}) {
    EXPECT_EQ(bluesOf(shotWithCamera(given)), kQuad) << given;
  }
  // The quad is 2 m away: a near plane beyond it, in metres, shows that the field counts.
  EXPECT_EQ(bluesOf(shotWithCamera({{"gltfCamera", 0}, {"near", 3}})), kNothing);
}

TEST_F(FacesAndCameras, WhatIsWrongWithTheChoiceOfACameraIsSaidWithTheCamerasThereAre) {
  expectRefused(shotWithCamera({}), {"camera: the scene has no camera of its own"});
  expectRefused(shotWithCamera({{"gltfCamera", "x"}}), {"camera.gltfCamera: there is no camera 'x'", "no cameras"});
  giveCameras({camera("perspective", "A"), camera("perspective", "B", 0.0), camera("orthographic", "Ortho")});
  for (const json& given : {json(), json::object(), json{{"near", 0.1}}}) {
    expectRefused(shotWithCamera(given), {"camera: the scene has 3 cameras", "0 'A', 1 'B', 2 'Ortho' (orthographic)"});
  }
  expectRefused(shotWithCamera({{"gltfCamera", "x"}}),
                {"camera.gltfCamera: there is no camera 'x'", "it has 0 'A', 1 'B'"});
  expectRefused(shotWithCamera({{"gltfCamera", 7}}),
                {"camera.gltfCamera: there is no camera 7", "it has 0 'A', 1 'B'"});
  for (const json& choice : {json(2), json("2"), json("Ortho")}) {
    expectRefused(shotWithCamera({{"gltfCamera", choice}}),
                  {"camera.gltfCamera: camera 2 'Ortho' is orthographic: only perspective cameras are rendered"});
  }
  expectRefused(shotWithCamera({{"gltfCamera", "B"}}), {"camera.gltfCamera: camera 1 'B' has yfov 0"});
  EXPECT_EQ(bluesOf(shotWithCamera({{"gltfCamera", "A"}})), kQuad) << "others may be nonsense";
}

TEST_F(FacesAndCameras, ManyCamerasWithLongNamesMakeAShortLine) {
  json cameras = json::array();
  for (int i = 0; i < 300; ++i) cameras.push_back(camera("perspective", std::string(1000, 'n') + std::to_string(i)));
  giveCameras(cameras);
  expectRefused(shotWithCamera({}), {"the scene has 300 cameras", "more"});
  expectRefused(shotWithCamera({{"gltfCamera", std::string(100000, 'x')}}),
                {"camera.gltfCamera: there is no camera 'x"});
}

TEST_F(FacesAndCameras, ACameraInTheDistanceIsToldSo) {
  expectRefused(shotWith("/camera/position", {0, 1e300, 0}), {"camera.position: is too far away"});
}

TEST_F(FacesAndCameras, ANestedFieldGivenTwiceIsNamedByItsWholePath) {
  write("shot.json", R"({"scene": [{"path": "quad.gltf"}], "camera": {"position": [0, 0, 0], "position": [0, 0, 1]}})");
  expectError({"render", "shot.json", "-o", "out.exr"}, 2, {"shot.json: camera.position: is given twice"});
}

class FormerFailures : public FacesAndCameras {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(kCases)) GTEST_SKIP() << "no files in " << kCases;
  }
};

TEST_F(FormerFailures, AreRight) {
  EXPECT_FLOAT_EQ(bluesOf(kCases / "15_from_behind.json").first, 0.3f) << "nothing but the background";
  EXPECT_FLOAT_EQ(bluesOf(kCases / "15_from_behind.json", {"--faces", "both"}).second, 0.2f) << "the back face";
  EXPECT_FLOAT_EQ(bluesOf(kCases / "16_alpha.json").second, 0.2f) << "drawn at the cutoff";
  EXPECT_GT(bluesOf(kCases / "unnamed_camera.json").first, 0.5f);
  expectError({"render", (kCases / "27_camera_error_without_file.json").string(), "-o", "out.exr"}, 2,
              {"27_camera_error_without_file.json: camera.gltfCamera: there is no camera 'x'"});
}

}  // namespace

}  // namespace lensgraph
