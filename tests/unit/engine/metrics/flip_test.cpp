// FLIP and HDR-FLIP: against the second implementation in flip_reference.py, against closed forms, and at the extremes.
#include "engine/metrics/flip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "engine/error.h"
#include "engine/metrics/hdr_flip.h"
#include "metrics/metric_pictures.h"
#include "metrics/python_check.h"

namespace lensgraph {
namespace {

using engine::FloatImage;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

float largestDifference(const FloatImage& map, const std::vector<float>& expected) {
  float largest = 0.0f;
  for (size_t i = 0; i < expected.size(); ++i) largest = std::fmax(largest, std::fabs(map.samples[i] - expected[i]));
  return largest;
}

/// Everything in [0,1]; NaN is not.
bool isMap(const FloatImage& map) {
  return std::all_of(map.samples.begin(), map.samples.end(), [](float v) { return v >= 0.0f && v <= 1.0f; });
}

// ---- Against the second implementation

struct Case {
  uint32_t width, height;
  double pixelsPerDegree;
  float brightest;
};

std::string lineFor(const std::string& kind, const Case& one, const test::TemporaryFolder& folder, size_t index) {
  const FloatImage reference = metricScene(one.width, one.height, one.brightest);
  const std::string name = (folder / (kind + std::to_string(index))).string();
  writeFloats(name + ".picture", metricMistake(reference, 5));
  writeFloats(name + ".reference", reference);
  std::ostringstream line;
  line.precision(17);
  line << kind << " " << one.pixelsPerDegree << " " << one.width << " " << one.height << " " << name << ".picture "
       << name << ".reference " << name << ".map";
  return line.str();
}

// 150 rows lie in three bands; 5×3 is smaller than the filters.
const std::vector<Case> kDisplayed = {
    {70, 150, engine::kFlipPixelsPerDegree, 1.0f}, {45, 40, 30.0, 1.0f}, {5, 3, engine::kFlipPixelsPerDegree, 1.0f}};

TEST(Flip, EqualsASecondImplementation) {
  const test::TemporaryFolder folder;
  std::vector<std::string> lines;
  for (size_t i = 0; i < kDisplayed.size(); ++i) lines.push_back(lineFor("ldr", kDisplayed[i], folder, i));
  if (!runPython("flip_reference.py", lines)) GTEST_SKIP() << kNoPython;
  for (size_t i = 0; i < kDisplayed.size(); ++i) {
    const Case& one = kDisplayed[i];
    const FloatImage reference = metricScene(one.width, one.height, one.brightest);
    const auto flip = engine::flip(metricMistake(reference, 5), reference, {.pixelsPerDegree = one.pixelsPerDegree});
    const auto expected = readFloats(folder / ("ldr" + std::to_string(i) + ".map"), reference.pixelCount());
    EXPECT_GT(flip.mean, 0.05);
    EXPECT_LT(largestDifference(flip.map, expected), 1e-4f) << i;
    RecordProperty("largestDifference" + std::to_string(i), std::to_string(largestDifference(flip.map, expected)));
  }
}

// 300 is a lamp, 1e4 a reflection of the sun.
const std::vector<Case> kHighRange = {{40, 70, engine::kFlipPixelsPerDegree, 300.0f}, {30, 20, 40.0, 1e4f}};

TEST(HdrFlip, EqualsASecondImplementation) {
  const test::TemporaryFolder folder;
  std::vector<std::string> lines;
  for (size_t i = 0; i < kHighRange.size(); ++i) lines.push_back(lineFor("hdr", kHighRange[i], folder, i));
  const auto printed = runPython("flip_reference.py", lines);
  if (!printed) GTEST_SKIP() << kNoPython;
  std::istringstream exposures(*printed);
  for (size_t i = 0; i < kHighRange.size(); ++i) {
    const Case& one = kHighRange[i];
    const FloatImage reference = metricScene(one.width, one.height, one.brightest);
    const auto flip = engine::hdrFlip(metricMistake(reference, 5), reference, one.pixelsPerDegree);
    double first = 0.0, last = 0.0;
    uint32_t count = 0;
    ASSERT_TRUE(exposures >> first >> last >> count);
    EXPECT_NEAR(flip.exposures.firstEv, first, 1e-6);
    EXPECT_NEAR(flip.exposures.lastEv, last, 1e-6);
    EXPECT_EQ(flip.exposures.count, count);
    const auto expected = readFloats(folder / ("hdr" + std::to_string(i) + ".map"), reference.pixelCount());
    EXPECT_LT(largestDifference(flip.map, expected), 1e-4f) << i;
    RecordProperty("largestDifference" + std::to_string(i), std::to_string(largestDifference(flip.map, expected)));
  }
}

// ---- Closed forms

TEST(Flip, OfAPictureAndItselfIsZero) {
  const FloatImage image = metricScene(30, 80, 3.0f);
  const auto flip = engine::flip(image, image);
  EXPECT_EQ(flip.mean, 0.0);
  EXPECT_EQ(*std::max_element(flip.map.samples.begin(), flip.map.samples.end()), 0.0f);
  EXPECT_EQ(engine::hdrFlip(image, image).mean, 0.0);
}

TEST(Flip, OfBlueAndGreenIsOne) {
  FloatImage blue(20, 20, 3), green(20, 20, 3);
  for (size_t i = 0; i < blue.samples.size(); i += 3) blue.samples[i + 2] = green.samples[i + 1] = 1.0f;
  EXPECT_NEAR(engine::flip(blue, green).mean, 1.0, 1e-5);
}

// Without edges FLIP is the colour difference alone. Black and white are 100 apart. Blue is (32.30, 79.20, -107.86) and green
// (87.74, -86.18, 83.18) in L*a*b*; with Hunt's effect (32.30, 25.58, -34.84) and (87.74, -75.61, 72.98): 203.30 apart.
TEST(Flip, OfBlackAndWhiteFollowsFromTheFormulas) {
  const FloatImage black(9, 9, 1), white(9, 9, 1, 1.0f);
  const double difference = std::pow(100.0, 0.7), largest = std::pow(203.3016, 0.7);
  const double expected = 0.95 + (difference - 0.4 * largest) / (0.6 * largest) * 0.05;
  EXPECT_NEAR(engine::flip(black, white).mean, expected, 1e-4);
}

TEST(Flip, DoesNotDependOnTheOrder) {
  const FloatImage reference = metricScene(31, 22, 1.0f), picture = metricMistake(reference, 3);
  EXPECT_EQ(engine::flip(picture, reference).map.samples, engine::flip(reference, picture).map.samples);
}

TEST(Flip, IsOfTheDisplayedPictures) {
  FloatImage two(12, 12, 3, 2.0f), thousand(12, 12, 3, 1000.0f);
  EXPECT_EQ(engine::flip(two, thousand).mean, 0.0);
  EXPECT_GT(engine::flip(two, thousand, {.exposureEv = -5.0}).mean, 0.5);
  EXPECT_GT(engine::hdrFlip(two, thousand).mean, 0.5);  // finds its exposure itself
}

TEST(Flip, AlphaIsNotCompared) {
  FloatImage a(6, 6, 4, 0.5f), b(6, 6, 3, 0.5f);
  for (size_t i = 3; i < a.samples.size(); i += 4) a.samples[i] = 0.1f;
  EXPECT_EQ(engine::flip(a, b).mean, 0.0);
}

TEST(Flip, MeanUnderAMaskIsOfItsPixels) {
  FloatImage map(2, 2, 1), mask(2, 2, 1);
  map.samples = {0.1f, 0.2f, 0.3f, 0.4f};
  EXPECT_EQ(engine::meanUnderMask(map, mask), 0.0);
  mask.samples = {0.0f, 1.0f, 0.0f, 1.0f};
  EXPECT_NEAR(engine::meanUnderMask(map, mask), 0.3, 1e-7);
}

// ---- Exposures

TEST(HdrFlip, TheBrightestAndTheMedianPixelAreMappedToTheirTarget) {
  FloatImage reference(3, 1, 1);
  reference.samples = {0.25f, 1.0f, 64.0f};
  const auto range = engine::hdrFlipExposures(reference);
  EXPECT_NEAR(range.lastEv - range.firstEv, 6.0, 1e-6);
  EXPECT_EQ(range.count, 6u);
  const double x = 0.6 * 64.0 * std::exp2(range.firstEv);  // Narkowicz's curve at the brightest pixel
  EXPECT_NEAR(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.85, 1e-6);
}

TEST(HdrFlip, AReferenceThatIsHalfBlackTakesTheMedianOfTheRest) {
  FloatImage reference(8, 1, 1);
  reference.samples = {0.0f, 0.0f, 0.0f, -3.0f, 0.0f, 0.5f, 2.0f, 8.0f};
  const auto range = engine::hdrFlipExposures(reference);
  EXPECT_NEAR(range.lastEv - range.firstEv, 2.0, 1e-6);
  EXPECT_EQ(range.count, 2u);
}

// ---- Extremes

TEST(Flip, StaysFiniteWhateverThePicturesHold) {
  const float values[] = {0.0f, -1.0f, 1e4f, kNan, kInfinity, -kInfinity, 3e38f, 1e-42f};
  for (const float value : values) {
    for (const float background : {0.0f, 0.5f, 1e4f}) {
      FloatImage picture(13, 7, 3, background), reference = metricScene(13, 7, 1e4f);
      picture.pixel(6, 3)[1] = value;
      EXPECT_TRUE(isMap(engine::flip(picture, reference).map)) << value;
      EXPECT_TRUE(isMap(engine::hdrFlip(picture, reference).map)) << value;
      EXPECT_TRUE(isMap(engine::flip(reference, picture).map)) << value;
      const auto flip = engine::hdrFlip(reference, picture);
      EXPECT_TRUE(isMap(flip.map)) << value << " " << background;
      EXPECT_TRUE(std::isfinite(flip.mean) && std::isfinite(flip.exposures.firstEv)) << value << " " << background;
    }
  }
}

TEST(Flip, OnePixelIsEnough) {
  const FloatImage a(1, 1, 3, 0.5f), b(1, 1, 3, 0.25f);
  EXPECT_GT(engine::flip(a, b).mean, 0.1);
  EXPECT_GT(engine::hdrFlip(a, b).mean, 0.1);
}

TEST(HdrFlip, OfABlackReferenceLooksAtOneExposure) {
  const FloatImage black(4, 4, 3), lit(4, 4, 3, 0.3f);
  EXPECT_EQ(engine::hdrFlip(lit, black).exposures.count, 1u);
  EXPECT_GT(engine::hdrFlip(lit, black).mean, 0.3);
  EXPECT_EQ(engine::hdrFlip(black, black).mean, 0.0);
}

TEST(HdrFlip, LimitsTheNumberOfExposures) {
  FloatImage reference(3, 1, 1);
  reference.samples = {1e-30f, 1e-30f, 1e30f};
  EXPECT_EQ(engine::hdrFlipExposures(reference).count, engine::kMostExposures);
}

TEST(Flip, RefusesWhatCannotBeCompared) {
  const FloatImage a(4, 4, 3), wide(5, 4, 3);
  EXPECT_THROW(engine::flip(a, wide), engine::Error);
  EXPECT_THROW(engine::hdrFlip(a, wide), engine::Error);
  EXPECT_THROW(engine::flip(a, a, {.pixelsPerDegree = 0.0}), engine::Error);
  EXPECT_THROW(engine::flip(a, a, {.pixelsPerDegree = kNan}), engine::Error);
}

}  // namespace
}  // namespace lensgraph
