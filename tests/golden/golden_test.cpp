// Pictures of the sample scenes, 160×90, against those in pictures/, which were looked at and found right: whatever changes
// a picture is seen in review. Rewrite them with LENSGRAPH_UPDATE_GOLDEN=1 in the environment, and look at them.
#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>

#include "engine/image/image_io.h"
#include "engine/metrics/metrics.h"
#include "tests/support/gpu/gpu_test.h"

namespace lensgraph {

namespace {

namespace fs = std::filesystem;

const fs::path kRoot = LENSGRAPH_SOURCE_DIR;

struct Golden {
  const char* scene;
  const char* technique;
  const char* variant;  ///< What is special about it; part of the file's name.
  passes::ParameterSet parameters = {};
  std::string name() const { return std::string(scene) + "_" + technique + (*variant != 0 ? "_" : "") + variant; }
  friend void PrintTo(const Golden& golden, std::ostream* out) { *out << golden.name(); }
};

const Golden kGoldens[] = {
    {"foreground_blur", "pinhole", "", {{"pixelSamples", int64_t{4}}}},
    {"foreground_blur", "accumulation", "", {{"lensSamples", int64_t{64}}}},
    {"foreground_blur", "two_pass_filter", ""},
    {"foreground_blur", "multiview_synthesis", ""},
    {"foreground_blur",
     "multiview_synthesis",
     "paper",
     {{"search", std::string("falsePosition")},
      {"jitter", std::string("noise")},
      {"border", 0.0},
      {"splitTriangles", false}}},
    {"railing_text_far", "multilayer_filtering", ""},
    {"railing_text_near", "multilayer_filtering", "antialiased", {{"antialiasing", std::string("2x2")}}},
    {"foliage", "multilayer_filtering", ""},
    {"glass_panes", "multilayer_filtering", ""},
    {"foreground_blur",
     "multilayer_filtering",
     "paper",
     {{"stackSteps", int64_t{3}},
      {"blend", std::string("additive")},
      {"levelMatch", std::string("diameter")},
      {"faces", std::string("front")},
      {"border", 0.0}}},
    {"crossing_branches", "multiview_synthesis", "views", {{"views", int64_t{8}}, {"lensSamples", int64_t{64}}}},
    {"glass_panes", "multiview_synthesis", ""},
    {"foliage", "multiview_synthesis", ""},
    {"reflective", "multiview_synthesis", "view_dependent", {{"viewDependent", true}}},
};

class GoldenPictures : public support::GpuTest, public testing::WithParamInterface<Golden> {};

TEST_P(GoldenPictures, AreUnchanged) {
  const Golden& golden = GetParam();
  host::Shot shot = host::readShot(kRoot / "samples/scenes" / (std::string(golden.scene) + ".json"));
  shot.width = 160, shot.height = 90;
  std::vector<std::string> warnings;
  host::Renderer renderer(support::device(), shot, warnings);
  const auto picture = support::render(renderer, shot, golden.technique, golden.parameters).color;
  const auto file = kRoot / "tests/golden/pictures" / (golden.name() + ".png");
  if (std::getenv("LENSGRAPH_UPDATE_GOLDEN") != nullptr) {
    engine::writeImage(file, picture);
    GTEST_SKIP() << "wrote " << file;
  }
  ASSERT_TRUE(fs::exists(file)) << file << " is missing; LENSGRAPH_UPDATE_GOLDEN=1 writes it";
  // The kept picture has 8 bits, which alone leaves 59 dB. Other devices and compilers round otherwise, and where an edge
  // passes through a sample they may let it fall to the other side: that leaves room for a few such pixels in a thousand.
  const auto metrics = engine::compareImages(picture, engine::readImage(file));
  std::printf("%s: %.1f dB\n", golden.name().c_str(), metrics.psnr);
  EXPECT_GE(metrics.psnr, 50.0);
}

INSTANTIATE_TEST_SUITE_P(Every, GoldenPictures, testing::ValuesIn(kGoldens),
                         [](const auto& info) { return info.param.name(); });

}  // namespace

}  // namespace lensgraph
