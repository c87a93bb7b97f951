// What each subcommand gives for good input, as a user sees it. Rendering runs with validation on: a message
// of the layers makes the exit status 1.
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <iterator>

#include "engine/image/image.h"
#include "engine/image/image_io.h"
#include "engine/metrics/metrics.h"
#include "passes/registry/registry.h"
#include "program.h"
#include "samples/host/technique_choice.h"

namespace lensgraph {

namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::StartsWith;

class GoodInput : public cli_test::ProgramTest {
 protected:
  GoodInput() {
    writeQuad();
    writeShot(shot());
  }
  /// Renders shot.json with validation into a picture.
  engine::FloatImage render(std::vector<std::string> arguments, const std::string& file = "out.exr") {
    arguments.insert(arguments.begin(), {"render", "shot.json", "--validate", "-o", file});
    said_ = runWell(arguments);
    return engine::readImage(folder() / file);
  }
  /// The quad fills the view with one colour, blurred or not (law of techniques: a constant stays constant).
  static void expectQuadColor(const engine::FloatImage& image) {
    const float color[3] = {0.25f, 0.5f, 0.75f};
    ASSERT_GE(image.channels, 3u);
    for (uint32_t y = 0; y < image.height; ++y) {
      for (uint32_t x = 0; x < image.width; ++x) {
        for (int i = 0; i < 3; ++i) ASSERT_NEAR(image.pixel(x, y)[i], color[i], 1e-3 * color[i]) << x << " " << y;
      }
    }
  }

  std::string said_;
};

TEST_F(GoodInput, EveryTechniqueRendersTheScene) {
  for (const auto& technique : host::techniques()) {
    SCOPED_TRACE(technique.name);
    const std::string name(technique.name);
    const auto image = render({"--technique", name}, name + ".exr");
    EXPECT_EQ(image.width, 32u);
    EXPECT_EQ(image.height, 24u);
    expectQuadColor(image);
    EXPECT_THAT(said_, HasSubstr("device "));
    EXPECT_THAT(said_, HasSubstr(name));
  }
}

TEST_F(GoodInput, EveryTechniqueHasAGraph) {
  for (const auto& technique : passes::techniques()) {
    SCOPED_TRACE(technique.name);
    const std::string name(technique.name);
    const auto outcome = run({"graph", "shot.json", "--technique", name, "--dot", "-", "--json", "graph.json"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_THAT(outcome.out, StartsWith("digraph"));
    EXPECT_THAT(outcome.err, HasSubstr("device "));
    std::ifstream file(folder() / "graph.json");
    EXPECT_TRUE(json::parse(file).is_object());
  }
}

TEST_F(GoodInput, SizeOnTheCommandLineWins) {
  const auto image = render({"--technique", "pinhole", "--size", "17x5"});
  EXPECT_EQ(image.width, 17u);
  EXPECT_EQ(image.height, 5u);
}

TEST_F(GoodInput, DepthIsViewDepthInMetres) {
  render({"--technique", "pinhole", "--depth-out", "z.exr"});
  const auto depth = engine::readDepth(folder() / "z.exr");
  EXPECT_NEAR(*depth.pixel(0, 0), 2.0f, 1e-4f);
  EXPECT_NEAR(*depth.pixel(16, 12), 2.0f, 1e-4f);
}

TEST_F(GoodInput, ExposureBrightensPng) {
  const auto dark = render({"--technique", "pinhole", "--exposure", "-1"}, "dark.png");
  EXPECT_NEAR(dark.pixel(5, 5)[1], 0.25f, 0.005f);
}

TEST_F(GoodInput, CaptureSaysWhatWasDone) {
  render(
      {"--technique", "accumulation", "--set", "lensSamples=4", "--set", "pixelJitter=false", "--capture", "c.json"});
  std::ifstream file(folder() / "c.json");
  const auto capture = json::parse(file);
  EXPECT_FALSE(capture["device"]["name"].get<std::string>().empty());
  EXPECT_FALSE(capture["device"]["driver"].get<std::string>().empty());
  EXPECT_FALSE(capture["program"]["version"].get<std::string>().empty());
  EXPECT_EQ(capture["shot"], "shot.json");
  EXPECT_EQ(capture["resolution"], json({32, 24}));
  EXPECT_EQ(capture["technique"]["name"], "accumulation");
  EXPECT_EQ(capture["technique"]["parameters"]["lensSamples"], 4);
  EXPECT_EQ(capture["technique"]["parameters"]["pixelJitter"], false);
  EXPECT_TRUE(capture["technique"]["parameters"].contains("pattern")) << "defaults are told too";
  EXPECT_GT(capture["gpuMs"]["median"].get<double>(), 0.0);
  EXPECT_GT(capture["wallMs"]["median"].get<double>(), 0.0);
  EXPECT_FALSE(capture["graph"]["passes"].empty());
  EXPECT_EQ(capture["graph"]["frames"], 5);
}

TEST_F(GoodInput, CaptureTellsInputsApart) {
  const auto hash = [&] {
    render({"--technique", "pinhole", "--capture", "c.json"});
    std::ifstream file(folder() / "c.json");
    return json::parse(file)["inputHash"].get<std::string>();
  };
  const auto first = hash();
  EXPECT_EQ(hash(), first);
  writeShot([&] {
    auto other = shot();
    other["lens"]["focusDistance"] = 1.5;
    return other;
  }());
  EXPECT_NE(hash(), first);
}

TEST_F(GoodInput, ConfigurationAndSettingsAreLayered) {
  write("config.json", R"({"technique": {"name": "accumulation", "lensSamples": 4}})");
  render({"--config", "config.json", "--set", "pixelJitter=false", "--capture", "c.json"});
  std::ifstream file(folder() / "c.json");
  const auto parameters = json::parse(file)["technique"]["parameters"];
  EXPECT_EQ(parameters["lensSamples"], 4);
  EXPECT_EQ(parameters["pixelJitter"], false);
}

TEST_F(GoodInput, ParametersOfTheShotStayWithItsTechnique) {
  auto given = shot();
  given["technique"] = {{"name", "accumulation"}, {"lensSamples", 4}};
  writeShot(given);
  render({"--technique", "pinhole"});  // has no lensSamples: must not be an error
  render({"--capture", "c.json"});
  std::ifstream file(folder() / "c.json");
  EXPECT_EQ(json::parse(file)["technique"]["parameters"]["lensSamples"], 4);
}

TEST_F(GoodInput, TechniquesOnAnyPictureWithDepth) {
  engine::FloatImage color(16, 12, 3, 0.5f), depth(16, 12, 1, 3.0f);
  engine::writeImage(folder() / "c.exr", color);
  engine::writeImage(folder() / "z.exr", depth);
  for (const auto& technique : passes::techniques()) {
    if (technique.input != passes::TechniqueInput::image) continue;
    SCOPED_TRACE(technique.name);
    runWell({"apply", "--validate", "--color", "c.exr", "--depth", "z.exr", "--fovy", "40", "--focal-length-mm", "50",
             "--fstop", "2", "--focus", "infinity", "--technique", std::string(technique.name), "-o", "out.exr"});
    const auto image = engine::readImage(folder() / "out.exr");
    EXPECT_NEAR(image.pixel(8, 6)[0], 0.5f, 5e-4f);
    EXPECT_NEAR(image.pixel(0, 0)[2], 0.5f, 5e-4f);
  }
}

TEST_F(GoodInput, OutputsAppearWholeAndAlone) {
  render({"--technique", "pinhole"});
  for (const auto& entry : std::filesystem::directory_iterator(folder())) {
    EXPECT_THAT(entry.path().filename().string(), testing::AnyOf("quad.gltf", "quad.bin", "shot.json", "out.exr"));
  }
}

TEST_F(GoodInput, CompareMeasures) {
  engine::FloatImage reference(32, 32, 3, 0.25f), picture = reference;
  engine::writeImage(folder() / "a.exr", reference);
  const auto equal = json::parse(runWell({"compare", "a.exr", "a.exr", "--json"}));
  EXPECT_EQ(equal["psnr"], "infinity");
  EXPECT_EQ(equal["ssim"], 1.0);
  EXPECT_EQ(equal["maxError"], 0.0);

  picture.pixel(3, 4)[1] = 0.5f;
  engine::writeImage(folder() / "b.exr", picture);
  const auto different = json::parse(runWell({"compare", "b.exr", "a.exr", "--json"}));
  const auto expected = engine::compareImages(picture, reference);
  EXPECT_DOUBLE_EQ(different["psnr"].get<double>(), expected.psnr);
  EXPECT_DOUBLE_EQ(different["maxErrorLinear"].get<double>(), 0.25);
  EXPECT_THAT(runWell({"compare", "b.exr", "a.exr"}),
              testing::AllOf(HasSubstr("PSNR"), HasSubstr("SSIM"), HasSubstr("maximum error")));
}

TEST_F(GoodInput, TechniquesAreListedWithUnitRangeAndDefault) {
  const auto listed = json::parse(runWell({"techniques", "--json"}))["techniques"];
  ASSERT_EQ(listed.size(), host::techniques().size());
  for (std::size_t i = 0; i < listed.size(); ++i) {
    const auto& technique = host::techniques()[i];
    EXPECT_EQ(listed[i]["name"], technique.name);
    ASSERT_EQ(listed[i]["parameters"].size(), technique.parameters.size());
    for (const auto& parameter : listed[i]["parameters"]) {
      EXPECT_TRUE(parameter.contains("unit"));
      EXPECT_TRUE(parameter.contains("default"));
      const std::string type = parameter["type"];
      EXPECT_EQ(parameter.contains("min"), type == "integer" || type == "number") << parameter;
    }
    EXPECT_THAT(runWell({"techniques"}), HasSubstr(std::string(technique.name)));
  }
}

TEST_F(GoodInput, DevicesAreListed) {
  const auto devices = json::parse(runWell({"devices", "--json"}))["devices"];
  ASSERT_FALSE(devices.empty());
  EXPECT_THAT(runWell({"devices"}), HasSubstr(devices[0]["name"].get<std::string>()));
}

TEST_F(GoodInput, HelpAndVersionGoToStdout) {
  EXPECT_THAT(runWell({"--version"}), StartsWith("lensgraph "));
  EXPECT_THAT(runWell({"--help"}), HasSubstr("render"));
  EXPECT_THAT(runWell({"render", "--help"}), HasSubstr("--technique"));
}

TEST_F(GoodInput, DemoWritesAPageWithItsPictures) {
  std::filesystem::create_directory(folder() / "scenes");
  for (const auto* file : {"quad.gltf", "quad.bin", "shot.json"}) {
    std::filesystem::copy(folder() / file, folder() / "scenes" / file);
  }
  const auto said =
      runWell({"demo", "--validate", "--scenes", "scenes", "-o", "demo", "--width", "32", "--reference-samples", "16"});
  std::ifstream stream(folder() / "demo" / "index.html");
  const std::string page{std::istreambuf_iterator<char>(stream), {}};
  EXPECT_THAT(said, testing::AllOf(HasSubstr("device"), HasSubstr("PSNR"), HasSubstr("index.html")));
  for (const auto& technique : passes::techniques()) {
    const std::string name(technique.name);
    EXPECT_THAT(said, HasSubstr(name));
    EXPECT_THAT(page, HasSubstr("shot/" + name + ".png"));
    EXPECT_TRUE(std::filesystem::exists(folder() / "demo/shot" / (name + ".png")));
    EXPECT_TRUE(std::filesystem::exists(folder() / "demo/shot" / (name + "_error.png")));
  }
}

// ---- Pictures that may not be what was meant

class Doubtful : public GoodInput {
 protected:
  /// Renders shot.json after a change of it, and returns the one warning.
  std::string warningOf(const std::string& pointer, const json& value, std::vector<std::string> arguments = {}) {
    json changed = shot();
    changed[json::json_pointer(pointer)] = value;
    writeShot(changed);
    arguments.insert(arguments.begin(), {"render", "shot.json", "-o", "out.png"});
    const auto outcome = run(arguments);
    EXPECT_EQ(outcome.status, 0);
    EXPECT_THAT(outcome.err, StartsWith("lensgraph: warning: "));
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    return outcome.err;
  }
};

TEST_F(Doubtful, ABlankPictureSaysWhy) {
  EXPECT_THAT(warningOf("/camera/near", 50.0, {"--technique", "pinhole"}),
              testing::AllOf(HasSubstr("nothing is beyond the near plane of 50 m"), HasSubstr("camera.near")));
}

TEST_F(Doubtful, AnIgnoredLensFieldIsNamed) {
  EXPECT_THAT(warningOf("/lens/bladeCount", 5, {"--technique", "two_pass_filter"}),
              HasSubstr("two_pass_filter ignores lens.bladeCount"));
}

TEST_F(Doubtful, AWhitePictureNamesAnExposure) {
  const auto warning = warningOf("/background", {1.0, 1.0, 1.0}, {"--technique", "pinhole", "--exposure", "5"});
  EXPECT_THAT(warning, HasSubstr("try --exposure 0.4"));
}

}  // namespace

}  // namespace lensgraph
