// Files on which the program once hung, swallowed memory, drew the wrong thing or said nothing of use. They stand beside the
// shots, outside the repository; the same faults have tests of their own that always run.
#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <algorithm>

#include "program.h"

namespace lensgraph {
namespace {

using nlohmann::json;
using testing::HasSubstr;

const std::filesystem::path kCases = std::filesystem::path(LENSGRAPH_SHOTS_DIR).parent_path() / "cases";

/// What the program may take: a hang ends with a signal, gigabytes with an error of another kind.
bool limitResources() {
  const rlimit seconds{30, 30}, bytes{rlim_t{4} << 30, rlim_t{4} << 30};
  return setrlimit(RLIMIT_CPU, &seconds) == 0 && setrlimit(RLIMIT_AS, &bytes) == 0;
}

class Cases : public cli_test::ProgramTest {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(kCases)) GTEST_SKIP() << "no files in " << kCases;
  }

  /// Renders a glTF file from in front of it; the status and one line, or none, are checked.
  void expectOfScene(const std::filesystem::path& scene, int status, const std::string& part) const {
    SCOPED_TRACE(scene);
    writeShot({{"scene", {{{"path", scene.string()}}}},
               {"camera", {{"position", {0.5, 0.7, 4}}, {"target", {0, 0, 0}}, {"fovyDeg", 40}}},
               {"lens", {{"apertureRadius", 0.01}, {"focusDistance", 4}}},
               {"resolution", {32, 24}}});
    expectOf({"render", "shot.json", "--technique", "pinhole", "-o", "out.exr"}, status, part);
  }
  void expectOf(const std::vector<std::string>& arguments, int status, const std::string& part) const {
    const auto outcome = run(arguments, limitResources);
    EXPECT_EQ(outcome.status, status) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(part));
    EXPECT_EQ(std::ranges::count(outcome.err, '\n'), part.empty() ? 0 : 1) << outcome.err;
    EXPECT_LE(outcome.err.size(), 520u);
  }
};

TEST_F(Cases, ScenesAreDrawnOrRefusedSoonInOneLine) {
  std::filesystem::copy_file(kCases / "scenes/07_uri_fifo.gltf", folder() / "07_uri_fifo.gltf");
  ASSERT_EQ(mkfifo((folder() / "fifo").c_str(), 0600), 0);
  expectOfScene(folder() / "07_uri_fifo.gltf", 2, "is not a file");
  const struct {
    const char* file;
    int status;
    const char* part;
  } scenes[] = {
      {"08_zero_accessor_20x16M.gltf", 2, "asks for more geometry than the file holds"},
      {"17_SimpleMorph_default_weights.gltf", 0, "animations are ignored"},
      {"18_draco_used_not_required.gltf", 2, "KHR_draco_mesh_compression"},
      {"20_percent_encoded_base64.gltf", 0, ""},
      {"22_zeros.glb", 2, "is neither glTF nor GLB"},
      {"24_matrix_last_row.gltf", 2, "nodes[0].matrix"},
  };
  for (const auto& [file, status, part] : scenes) expectOfScene(kCases / "scenes" / file, status, part);
}

TEST_F(Cases, ShotsThatWereSilentSaySomething) {
  const auto render = [](const char* shot, const char* technique) -> std::vector<std::string> {
    return {"render", (kCases / "scenes" / shot).string(), "--technique", technique, "--size", "32x24", "-o",
            "out.exr"};
  };
  expectOf(render("blades_ignored.json", "two_pass_filter"), 0, "two_pass_filter ignores lens.bladeCount");
  expectOf(render("blades_ignored.json", "multilayer_filtering"), 0, "only the blur's size follow lens.bladeCount");
  expectOf(render("macro_default_near.json", "pinhole"), 0, "nothing is beyond the near plane");
}

TEST_F(Cases, LargeFilesTakeLinearTimeAndOneLine) {
  // As 30_make_large_inputs.py writes them.
  json gltf = {{"asset", {{"version", "2.0"}}},
               {"scenes", {{{"nodes", {0}}}}},
               {"nodes", {{{"mesh", 0}}}},
               {"buffers", {{{"byteLength", 480000}, {"uri", "zeros.bin"}}}},
               {"bufferViews", {{{"buffer", 0}, {"byteLength", 480000}}}},
               {"accessors", {{{"bufferView", 0}, {"componentType", 5126}, {"count", 40000}, {"type", "VEC3"}}}}};
  write("zeros.bin", std::string(480000, '\0'));
  gltf["meshes"][0]["primitives"] = json(10000, json{{"attributes", {{"POSITION", 0}}}});
  write("shared.gltf", gltf.dump());
  expectOfScene(folder() / "shared.gltf", 2, "asks for more geometry than the file holds");

  gltf["meshes"][0]["primitives"] = json(100000, json{{"attributes", {{"POSITION", 0}}}, {"mode", 1}});
  write("lines.gltf", gltf.dump());
  writeShot({{"scene", {{{"path", "lines.gltf"}}}},
             {"camera", {{"position", {0.5, 0.7, 4}}, {"target", {0, 0, 0}}, {"fovyDeg", 40}}},
             {"lens", {{"apertureRadius", 0.01}, {"focusDistance", 4}}}});
  const auto drawn =
      run({"render", "shot.json", "--technique", "pinhole", "--size", "8x8", "-o", "out.exr"}, limitResources);
  EXPECT_EQ(drawn.status, 0);
  EXPECT_THAT(drawn.err, HasSubstr("line primitives are not drawn (100,000 of them)"));
  EXPECT_EQ(std::ranges::count(drawn.err, '\n'), 2) << "and that nothing is to be seen: " << drawn.err;

  write("control.json", "{\"description\":\"" + std::string(1000000, 'x') + "\x01\"}");
  expectOf({"render", "control.json", "-o", "out.exr"}, 2, "control.json: line 1");
}

}  // namespace
}  // namespace lensgraph
