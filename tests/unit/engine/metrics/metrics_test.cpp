// Metrics against closed forms and against a second, direct implementation of the published formulas.
#include "engine/metrics/metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "engine/error.h"
#include "engine/image/srgb.h"
#include "engine/metrics/displayed.h"
#include "engine/metrics/ssim.h"

namespace lensgraph {

namespace {

using engine::compareImages;
using engine::FloatImage;
using engine::Metrics;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

FloatImage noise(uint32_t width, uint32_t height, uint32_t channels, unsigned seed, float least = 0.0f,
                 float most = 1.0f) {
  FloatImage image(width, height, channels);
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> uniform(least, most);
  for (float& sample : image.samples) sample = uniform(random);
  return image;
}

// ---- Displayed picture and PSNR

TEST(Metrics, SrgbCurveHasItsPublishedValues) {
  EXPECT_FLOAT_EQ(engine::srgbFromLinear(0.0f), 0.0f);
  EXPECT_EQ(engine::srgbFromLinear(1.0f), 1.0f);
  EXPECT_NEAR(engine::srgbFromLinear(0.002f), 0.02584f, 1e-6);
  EXPECT_NEAR(engine::srgbFromLinear(0.18f), 0.4613561f, 1e-6);
  EXPECT_NEAR(engine::linearFromSrgb(0.5f), 0.2140411f, 1e-6);
  for (int i = 0; i <= 255; ++i) {
    EXPECT_NEAR(engine::srgbFromLinear(engine::linearFromSrgb(i / 255.0f)), i / 255.0f, 2e-6);
  }
}

TEST(Metrics, DisplayedExposesClampsAndEncodes) {
  FloatImage image(2, 1, 4);
  image.samples = {0.09f, -1.0f, 7.0f, 0.5f, kNan, kInfinity, -kInfinity, 1.0f};
  const FloatImage shown = engine::displayed(image, 1.0);
  ASSERT_EQ(shown.channels, 3u);
  const float expected[] = {0.4613561f, 0.0f, 1.0f, 0.0f, 1.0f, 0.0f};
  for (size_t i = 0; i < 6; ++i) EXPECT_NEAR(shown.samples[i], expected[i], 1e-6) << i;
}

TEST(Metrics, IdenticalPicturesAreInfinitelyClose) {
  const FloatImage image = noise(20, 15, 3, 1, -0.5f, 3.0f);
  const Metrics metrics = compareImages(image, image);
  EXPECT_EQ(metrics.psnr, std::numeric_limits<double>::infinity());
  EXPECT_NEAR(metrics.ssim.value(), 1.0, 1e-12);
  EXPECT_EQ(metrics.relativeRmse, 0.0);
  EXPECT_EQ(metrics.maxErrorLinear, 0.0);
  EXPECT_EQ(metrics.pixelCount, 300u);
}

TEST(Metrics, PsnrOfAConstantDifferenceInEncodedValues) {
  FloatImage a(4, 4, 3, engine::linearFromSrgb(0.5f)), b(4, 4, 3, engine::linearFromSrgb(0.6f));
  const Metrics metrics = compareImages(a, b);
  EXPECT_NEAR(metrics.psnr, 20.0, 1e-4);
  EXPECT_NEAR(metrics.maxErrorDisplayed, 0.1, 1e-6);
}

TEST(Metrics, PsnrIsOfTheThreeChannelsTogether) {
  FloatImage a(4, 4, 3), b(4, 4, 3);
  for (size_t i = 0; i < a.samples.size(); i += 3) b.samples[i + 1] = 1.0f;  // a third of all samples is wrong by 1
  EXPECT_NEAR(compareImages(a, b).psnr, 10.0 * std::log10(3.0), 1e-9);
}

TEST(Metrics, ClampHidesWhatADisplayHides) {
  FloatImage a(4, 4, 3, 2.0f), b(4, 4, 3, 1000.0f);
  const Metrics metrics = compareImages(a, b);
  EXPECT_EQ(metrics.psnr, std::numeric_limits<double>::infinity());
  EXPECT_EQ(metrics.maxErrorLinear, 998.0);
  EXPECT_NEAR(metrics.relativeRmse, 0.998, 1e-9);
  EXPECT_LT(compareImages(a, b, {.exposureEv = -5.0}).psnr, 7.0);
}

TEST(Metrics, RelativeRmseOfABlackReferenceIsInfinite) {
  FloatImage black(3, 3, 3), lit(3, 3, 3, 0.1f);
  EXPECT_EQ(compareImages(lit, black).relativeRmse, std::numeric_limits<double>::infinity());
  EXPECT_EQ(compareImages(black, black).relativeRmse, 0.0);
}

TEST(Metrics, AlphaIsNotCompared) {
  FloatImage a(4, 4, 4, 0.5f), b(4, 4, 3, 0.5f);
  for (size_t i = 3; i < a.samples.size(); i += 4) a.samples[i] = 0.1f;
  EXPECT_EQ(compareImages(a, b).psnr, std::numeric_limits<double>::infinity());
}

// ---- SSIM

// Wang 2004 as it is written, in two dimensions and long double: nothing shared with the code under test.
long double directSsim(const FloatImage& a, const FloatImage& b) {
  const int width = static_cast<int>(a.width), height = static_cast<int>(a.height);
  long double weights[11][11], sum = 0;
  for (int j = 0; j < 11; ++j) {
    for (int i = 0; i < 11; ++i) {
      sum += weights[j][i] = std::exp(-((i - 5) * (i - 5) + (j - 5) * (j - 5)) / (2.0L * 1.5L * 1.5L));
    }
  }
  long double total = 0;
  int count = 0;
  for (int y = 5; y < height - 5; ++y) {
    for (int x = 5; x < width - 5; ++x) {
      long double ma = 0, mb = 0;
      const auto at = [&](const FloatImage& image, int i, int j) -> long double {
        return image.samples[static_cast<size_t>((y + j - 5) * width + x + i - 5)];
      };
      for (int j = 0; j < 11; ++j) {
        for (int i = 0; i < 11; ++i) {
          ma += weights[j][i] / sum * at(a, i, j);
          mb += weights[j][i] / sum * at(b, i, j);
        }
      }
      long double va = 0, vb = 0, cov = 0;
      for (int j = 0; j < 11; ++j) {
        for (int i = 0; i < 11; ++i) {
          va += weights[j][i] / sum * (at(a, i, j) - ma) * (at(a, i, j) - ma);
          vb += weights[j][i] / sum * (at(b, i, j) - mb) * (at(b, i, j) - mb);
          cov += weights[j][i] / sum * (at(a, i, j) - ma) * (at(b, i, j) - mb);
        }
      }
      const long double c1 = 0.0001L, c2 = 0.0009L;
      total += (2 * ma * mb + c1) * (2 * cov + c2) / ((ma * ma + mb * mb + c1) * (va + vb + c2));
      ++count;
    }
  }
  return total / count;
}

FloatImage encodedLuma(const FloatImage& image) {
  const FloatImage shown = engine::displayed(image, 0.0);
  FloatImage luma(image.width, image.height, 1);
  for (size_t i = 0; i < luma.samples.size(); ++i) {
    const float* p = shown.samples.data() + 3 * i;
    luma.samples[i] = static_cast<float>(0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2]);
  }
  return luma;
}

TEST(Metrics, SsimEqualsTheDirectFormula) {
  const FloatImage reference = noise(37, 23, 3, 7);
  FloatImage image = reference;
  const FloatImage disturbance = noise(37, 23, 3, 8, -0.2f, 0.2f);
  for (size_t i = 0; i < image.samples.size(); ++i) image.samples[i] += disturbance.samples[i];
  const double expected = static_cast<double>(directSsim(encodedLuma(image), encodedLuma(reference)));
  const double measured = compareImages(image, reference).ssim.value();
  EXPECT_LT(expected, 0.99);
  EXPECT_GT(expected, 0.3);
  EXPECT_NEAR(measured, expected, 1e-6);
}

TEST(Metrics, SsimOfTwoConstantsIsItsLuminanceTerm) {
  const float x = 0.25f, y = 0.5f;
  FloatImage a(16, 16, 1, engine::linearFromSrgb(x)), b(16, 16, 1, engine::linearFromSrgb(y));
  EXPECT_NEAR(compareImages(a, b).ssim.value(), (2 * x * y + 1e-4) / (x * x + y * y + 1e-4), 1e-6);
}

// scipy's mode 'reflect' repeats the edge sample; at a corner of a ramp the mean is known by hand.
TEST(Metrics, SsimMapMirrorsAtTheBorders) {
  FloatImage a(11, 11, 1), b(11, 11, 1, 0.5f);
  for (uint32_t y = 0; y < 11; ++y) {
    for (uint32_t x = 0; x < 11; ++x) *a.pixel(x, y) = 0.1f * static_cast<float>(x);
  }
  double weights[6], sum = 0.0, mean = 0.0, square = 0.0;
  for (int k = 0; k <= 5; ++k) weights[k] = std::exp(-k * k / 4.5);
  for (int k = -5; k <= 5; ++k) {
    const int x = k >= 0 ? k : -k - 1;
    sum += weights[std::abs(k)];
    mean += weights[std::abs(k)] * 0.1 * x;
    square += weights[std::abs(k)] * 0.01 * x * x;
  }
  mean /= sum;
  const double variance = square / sum - mean * mean;
  const double expected = (2 * mean * 0.5 + 1e-4) * 9e-4 / ((mean * mean + 0.25 + 1e-4) * (variance + 9e-4));
  EXPECT_NEAR(*engine::ssimMap(a, b).pixel(0, 0), expected, 1e-5);
}

TEST(Metrics, SsimIsAbsentBelowItsWindow) {
  const FloatImage small = noise(10, 30, 3, 1);
  EXPECT_FALSE(compareImages(small, small).ssim.has_value());
  const FloatImage enough = noise(11, 11, 3, 1);
  EXPECT_TRUE(compareImages(enough, enough).ssim.has_value());
}

// ---- Masks, bad values, misuse

TEST(Metrics, MaskLimitsEverythingToItsPixels) {
  FloatImage a(20, 20, 3, 0.2f), b = a, mask(20, 20, 1);
  b.pixel(10, 10)[0] = 0.9f;
  *mask.pixel(3, 3) = 1.0f;
  EXPECT_EQ(compareImages(a, b, {.mask = &mask}).psnr, std::numeric_limits<double>::infinity());
  EXPECT_FALSE(compareImages(a, b, {.mask = &mask}).ssim.has_value());  // the border of 5 px swallows it
  *mask.pixel(10, 10) = 0.5f;
  const Metrics metrics = compareImages(a, b, {.mask = &mask});
  EXPECT_EQ(metrics.pixelCount, 2u);
  EXPECT_NEAR(metrics.maxErrorLinear, 0.7, 1e-6);
  EXPECT_TRUE(metrics.ssim.has_value());
}

TEST(Metrics, NonFinitePixelsAreCountedAndDisplayed) {
  FloatImage reference(12, 12, 3, 1.0f), image = reference;
  image.pixel(5, 5)[1] = kNan;
  image.pixel(6, 5)[0] = kInfinity;
  reference.pixel(1, 1)[2] = -kInfinity;
  const Metrics metrics = compareImages(image, reference);
  EXPECT_EQ(metrics.nonFinitePixels, 2u);
  EXPECT_EQ(metrics.nonFiniteReference, 1u);
  EXPECT_EQ(metrics.maxErrorDisplayed, 1.0);  // NaN shows as black on white
  EXPECT_EQ(metrics.maxErrorLinear, 0.0);
  EXPECT_TRUE(std::isfinite(metrics.psnr));
  EXPECT_TRUE(std::isfinite(metrics.relativeRmse));
  EXPECT_TRUE(std::isfinite(metrics.ssim.value()));
}

TEST(Metrics, RefusesWhatCannotBeCompared) {
  const FloatImage a(4, 4, 3), wide(5, 4, 3), two(4, 4, 2), emptyMask(4, 4, 1), wrongMask(5, 4, 1);
  EXPECT_THROW(compareImages(a, wide), engine::Error);
  EXPECT_THROW(compareImages(a, two), engine::Error);
  EXPECT_THROW(compareImages(FloatImage{}, FloatImage{}), engine::Error);
  EXPECT_THROW(compareImages(a, a, {.mask = &emptyMask}), engine::Error);
  EXPECT_THROW(compareImages(a, a, {.mask = &wrongMask}), engine::Error);
}

TEST(Metrics, OnePixelIsEnough) {
  const FloatImage a(1, 1, 3, 0.5f), b(1, 1, 3, 0.25f);
  const Metrics metrics = compareImages(a, b);
  EXPECT_NEAR(metrics.maxErrorLinear, 0.25, 1e-7);
  EXPECT_FALSE(metrics.ssim.has_value());
}

}  // namespace

}  // namespace lensgraph
