// The same bits whatever the course: threads, interruptions, later continuations. And states that belong elsewhere.
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "engine/error.h"
#include "tests/support/temporary_folder.h"
#include "traced.h"

namespace lensgraph::test {
namespace {

using testing::HasSubstr;

class RayTracedState : public testing::Test {
 protected:
  RayTracedState() {
    for (int i = 0; i < 12; ++i) {
      const glm::vec4 color(0.1f * static_cast<float>(i), 0.5f, 0.9f, i % 3 == 0 ? 0.4f : 1.0f);
      addQuad(scene_, 1.0 + 0.4 * i, 0.1 * (i % 5) - 0.2, 0.08 * (i % 4) - 0.1, 0.06 * (i + 1), 0.05,
              addMaterial(scene_, color));
    }
    view_.lens.bladeCount = 5;
    view_.lens.opticalVignetting = 0.5;
    options_.samples = 40;
    options_.checkpointInterval = std::chrono::milliseconds(0);
  }
  std::vector<float> samples() const { return engine::traceRays(scene_, nullptr, view_, options_).color.samples; }
  std::filesystem::path file() const { return folder_ / "state"; }
  std::string complaint() const {
    try {
      samples();
    } catch (const engine::Error& error) {
      EXPECT_EQ(error.kind(), engine::ErrorKind::badInput);
      return error.what();
    }
    return "no error";
  }

  TemporaryFolder folder_;
  engine::Scene scene_;
  engine::RayTracedView view_ = smallView(50, 34);
  engine::RayTracerOptions options_;
};

TEST_F(RayTracedState, ThreadsChangeNoBit) {
  options_.threads = 1;
  const auto one = samples();
  options_.threads = 7;
  EXPECT_EQ(samples(), one);
  options_.seed = 1;
  EXPECT_NE(samples(), one);
}

TEST_F(RayTracedState, AnInterruptedPictureGoesOnToTheSameBits) {
  const auto whole = samples();
  options_.checkpoint = file();
  uint32_t lastDone = 0;
  options_.progress = [&](uint32_t done, uint32_t total) {
    if (done > total / 2) throw std::runtime_error("interrupted");
    lastDone = done;
  };
  EXPECT_THROW(samples(), std::runtime_error);
  ASSERT_TRUE(std::filesystem::exists(file()));
  uint32_t total = 0;
  options_.progress = [&](uint32_t, uint32_t all) { total = all; };
  EXPECT_EQ(samples(), whole);
  EXPECT_LT(total, 40u / 8u * 12u) << "less is left to do than the whole picture's 5 rounds of 12 tiles";
  EXPECT_EQ(folder_.names().size(), 1u);
}

TEST_F(RayTracedState, AFinishedPictureIsGivenMoreSamples) {
  const auto whole = samples();
  options_.checkpoint = file();
  options_.samples = 13;
  EXPECT_NE(samples(), whole);
  options_.samples = 40;
  EXPECT_EQ(samples(), whole);
  options_.samples = 2;
  EXPECT_EQ(engine::traceRays(scene_, nullptr, view_, options_).samples, 40u);
}

TEST_F(RayTracedState, AStateOfAnotherPictureIsRefusedByTheNameOfWhatDiffers) {
  options_.checkpoint = file();
  options_.samples = 1;
  samples();
  const auto refuses = [&](auto& value, auto other, const char* name) {
    std::swap(value, other);
    EXPECT_THAT(complaint(), testing::AllOf(HasSubstr("is of another"), HasSubstr(name)));
    std::swap(value, other);
  };
  refuses(view_.width, 51u, "size");
  refuses(view_.lens.focusDistance, 3.0, "focus distance");
  refuses(view_.lens.apertureRadius, 0.03, "aperture radius");
  refuses(view_.background[1], 0.5f, "background");
  refuses(view_.camera.fovy, 0.5, "camera");
  refuses(view_.viewpoint.lit, true, "shading");
  refuses(options_.seed, 7u, "seed");
  refuses(options_.filter, engine::PixelFilter::tent, "pixel filter");
  refuses(scene_.primitives[3].positions[0].x, 0.3f, "geometry");
  refuses(scene_.materials[3].baseColorFactor.g, 0.3f, "materials");
  EXPECT_EQ(complaint(), "no error");
}

TEST_F(RayTracedState, DamagedAndForeignFilesAreRefused) {
  options_.checkpoint = file();
  options_.samples = 1;
  samples();
  const auto bytes = readBytes(file());
  auto changed = bytes;
  changed[changed.size() - 100] ^= 1;
  writeBytes(file(), changed);
  EXPECT_THAT(complaint(), HasSubstr("is damaged"));
  writeBytes(file(), std::span(bytes).first(bytes.size() / 2));
  EXPECT_THAT(complaint(), HasSubstr("is damaged"));
  std::ofstream(file()) << "a letter";
  EXPECT_THAT(complaint(), HasSubstr("is no state"));
  options_.checkpoint = folder_.path();
  EXPECT_THAT(complaint(), HasSubstr("is no file"));
}

}  // namespace
}  // namespace lensgraph::test
