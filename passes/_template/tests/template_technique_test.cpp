// template_technique on a device: its picture where that is known, and the laws that every technique is held to.
#include "passes/_template/template_technique.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/gpu/techniques/image_technique.h"
#include "tests/support/gpu/gpu_test.h"

namespace lensgraph {

namespace {

using support::ImageInput;
using support::ImageOutput;
using support::Rgba;

constexpr uint32_t kSide = 64;  // px

/// A picture whose depth buffer holds vergence: focused at 1/2 m, blurred by 20 px a dioptre.
ImageInput picture(float vergence) {
  ImageInput input;
  input.extent = {kSide, kSide};
  input.color.assign(kSide * kSide, {0.25f, 3.0f, 0.001f, 1.0f});
  input.depth.assign(kSide * kSide, vergence);
  input.lens = {
      .cocScale = 20.0f, .focusVergence = 0.5f, .maxCocRadius = 1e30f, .vergenceScale = 1.0f, .vergenceOffset = 0.0f};
  return input;
}

class TemplateTechnique : public support::GpuTest {
 protected:
  ImageOutput run(const ImageInput& input, const passes::ParameterSet& parameters = {}) {
    return runner_.run(passes::template_technique::technique(), input, parameters);
  }

 private:
  support::ImageTechniqueRunner runner_;
};

float at(const ImageOutput& output, uint32_t x, uint32_t y) {
  return output.color[y * kSide + x][1];
}

}  // namespace

TEST_F(TemplateTechnique, HandsThePictureThroughWithoutAnAperture) {
  ImageInput input = picture(0.0f);
  input.lens.cocScale = 0.0f;
  EXPECT_EQ(run(input).color, input.color);
}

TEST_F(TemplateTechnique, LeavesWhatIsInFocusAsItIs) {
  ImageInput input = picture(0.5f);
  input.color[20 * kSide + 30] = {0.0f, 100.0f, 0.0f, 1.0f};
  EXPECT_EQ(run(input, {{"samples", int64_t{1}}}).color, input.color);
}

TEST_F(TemplateTechnique, KeepsAConstantColor) {
  const ImageInput input = picture(0.0f);
  float worst = 0.0f;
  for (const Rgba& texel : run(input).color) {
    for (std::size_t c = 0; c < 4; ++c) worst = std::max(worst, std::abs(texel[c] / input.color[0][c] - 1.0f));
  }
  EXPECT_LE(worst, 1e-5f);
}

TEST_F(TemplateTechnique, BlursAnEdgeOverItsCircleOfConfusion) {
  ImageInput input = picture(0.0f);  // |c| is 10 px.
  for (uint32_t y = 0; y < kSide; ++y) {
    for (uint32_t x = 0; x < kSide; ++x) input.color[y * kSide + x] = {0.0f, x < kSide / 2 ? 0.0f : 1.0f, 0.0f, 1.0f};
  }
  const ImageOutput blurred = run(input, {{"samples", int64_t{256}}});
  EXPECT_EQ(at(blurred, kSide / 2 - 12, 32), 0.0f);
  EXPECT_EQ(at(blurred, kSide / 2 + 12, 32), 1.0f);
  EXPECT_NEAR(at(blurred, kSide / 2 - 1, 32) + at(blurred, kSide / 2, 32), 1.0f, 0.05f);
  // A pixel whose center is 4.5 px from the edge sees the share of a disc beyond a chord: (acos a - a sqrt(1 - a^2)) / pi
  // with a = 4.5 / 10.
  EXPECT_NEAR(at(blurred, kSide / 2 - 5, 32), 0.2235f, 0.02f);
}

TEST_F(TemplateTechnique, DoesNotSpreadWhatIsNotFinite) {
  ImageInput input = picture(0.0f);
  input.color[20 * kSide + 30][0] = std::numeric_limits<float>::quiet_NaN();
  input.color[40 * kSide + 10][1] = std::numeric_limits<float>::infinity();
  input.depth[5 * kSide + 5] = std::numeric_limits<float>::quiet_NaN();
  const ImageOutput output = run(input);
  for (const Rgba& texel : output.color) {
    for (const float channel : texel) EXPECT_TRUE(std::isfinite(channel));
  }
  EXPECT_EQ(output.statistics.replacedTexels, 3u);
}

TEST_F(TemplateTechnique, GivesTheSameBitsAgain) {
  ImageInput input = picture(0.1f);
  for (std::size_t i = 0; i < input.color.size(); ++i) input.color[i][1] = static_cast<float>((i * 7919) % 101);
  EXPECT_EQ(run(input).color, run(input).color);
}

}  // namespace lensgraph
