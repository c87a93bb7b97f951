// shaders/shared/lens.h and aperture.h say the same in GLSL as in C++, value by value, extremes included.
//
// Tolerances. The lens is one multiplication and one addition, which Vulkan rounds correctly but may
// contract: one rounding of the larger operand apart (measured on lavapipe: no difference). The aperture adds
// sin, cos (2 ulp) and atan, of which lavapipe has 3.5e-6 rad: through the slope of a blade's edge, at most
// tan(60°), twice for the square, 1.2e-5 of the value. Vignetting is 0 or 1 and may differ only on its edge.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "engine/graph/graph_backend.h"
#include "engine/vulkan/command_buffers.h"
#include "rendergraph/executor.h"
#include "spirv/test/lens_comp.h"
#include "tests/gpu/shaders/lens_cases.h"
#include "tests/support/gpu/gpu_test.h"

namespace lensgraph {

namespace {

using rendergraph::Usage;
using shared::LensCase;
using shared::LensCaseResult;

const rendergraph::ComputeProgram kProgram{"test.lens", test_lens_comp};

std::vector<LensCaseResult> onDevice(const std::vector<LensCase>& cases) {
  const auto input = engine::makeBuffer(support::device(), cases.size() * sizeof(LensCase),
                                        VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                        rendergraph::MemoryKind::device, "lens cases");
  engine::upload(support::device(), input, std::as_bytes(std::span(cases)));
  engine::GraphBackend backend(support::device());
  rendergraph::Executor executor(backend);
  rendergraph::Graph graph;
  const rendergraph::AccessState uploaded{.stages = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                                          .access = VK_ACCESS_2_MEMORY_READ_BIT};
  const auto given = graph.importBuffer("cases", {.size = input.size},
                                        {.buffer = input.buffer.get(),
                                         .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                                         .before = uploaded,
                                         .after = uploaded});
  const VkDeviceSize size = cases.size() * sizeof(LensCaseResult);
  auto found = graph.createBuffer("results", {.size = size});
  auto evaluate = graph.addPass("evaluate", rendergraph::PassKind::compute);
  evaluate.read(given, Usage::storage);
  found = evaluate.write(found, Usage::storage);
  evaluate.record([=, count = static_cast<uint32_t>(cases.size())](rendergraph::PassContext& context) {
    const std::array bindings = {rendergraph::storage(given), rendergraph::storage(found)};
    context.dispatch({.program = kProgram,
                      .bindings = bindings,
                      .groups = {(count + shared::kLensCaseGroup - 1) / shared::kLensCaseGroup, 1, 1}});
  });
  auto bytes = graph.createBuffer("bytes", {.size = size, .memory = rendergraph::MemoryKind::readback});
  auto copy = graph.addPass("copy", rendergraph::PassKind::transfer);
  copy.read(found, Usage::transferSource);
  bytes = copy.write(bytes, Usage::transferDestination);
  copy.record([=](rendergraph::PassContext& context) { context.copyBuffer(found, bytes, size); });
  graph.exportBuffer(bytes, {.stages = VK_PIPELINE_STAGE_2_HOST_BIT, .access = VK_ACCESS_2_HOST_READ_BIT});
  executor.execute(graph);
  std::vector<LensCaseResult> results(cases.size());
  std::memcpy(results.data(), executor.mapped(bytes).data(), size);
  return results;
}

/// Every extreme with every other, then random ones.
std::vector<LensCase> lensCases() {
  std::vector<LensCase> cases;
  LensCase base{};
  base.shape.anamorphicRatio = 1.0f;
  for (const float k : {0.0f, 1e-20f, 1.0f, 73.5f, 1e6f, 1e30f, 3e38f}) {
    for (const float focus : {0.0f, 1e-9f, 0.3f, 1.0f, 100.0f}) {
      for (const float vergence : {0.0f, 1e-30f, 0.3f, 0.30000004f, 1.0f, 1e4f, -2.0f, -1e10f}) {
        for (const float limit : {1e30f, 20.0f, 0.0f}) {
          base.lens = {.cocScale = k,
                       .focusVergence = focus,
                       .maxCocRadius = limit,
                       .vergenceScale = 100.0f,
                       .vergenceOffset = 0.0f};
          base.vergence = vergence;
          base.depthBuffer = vergence * 0.01f;
          cases.push_back(base);
        }
      }
    }
  }
  std::mt19937 random(20);
  std::uniform_real_distribution<float> unit(-1.0f, 1.0f), exponent(-6.0f, 6.0f);
  const auto any = [&] { return unit(random) * std::pow(10.0f, exponent(random)); };
  for (int i = 0; i < 20000; ++i) {
    base.lens = {.cocScale = std::abs(any()),
                 .focusVergence = std::abs(any()),
                 .maxCocRadius = i % 2 == 0 ? 1e30f : std::abs(any()),
                 .vergenceScale = any(),
                 .vergenceOffset = any()};
    base.vergence = any();
    base.depthBuffer = any();
    cases.push_back(base);
  }
  return cases;
}

std::vector<LensCase> apertureCases() {
  std::vector<LensCase> cases;
  std::mt19937 random(21);
  std::uniform_real_distribution<float> unit(-1.0f, 1.0f), share(0.0f, 1.0f);
  constexpr uint32_t kBlades[] = {0, 3, 4, 5, 6, 7, 9, 16};
  constexpr float kRatios[] = {1.0f, 2.0f, 0.25f, 4.0f};
  for (int i = 0; i < 40000; ++i) {
    LensCase c{};
    c.shape = {.bladeCount = kBlades[i % 8],
               .bladeRotation = 3.1415927f * unit(random),
               .bladeCurvature = i % 3 == 0   ? 0.0f
                                 : i % 3 == 1 ? 1.0f
                                              : share(random),
               .anamorphicRatio = kRatios[i % 4],
               .opticalVignetting = i % 5 == 0 ? 0.0f : share(random),
               .sphericalAberration = i % 7 == 0 ? 0.0f : unit(random),
               .gaussian = i % 11 == 0 ? 1u : 0u,
               .padding = 0.0f};
    // The axes and the centre too.
    c.lensX = i % 13 == 0 ? 0.0f : 1.5f * unit(random);
    c.lensY = i % 17 == 0 ? 0.0f : 1.5f * unit(random);
    c.placeX = unit(random);
    c.placeY = unit(random);
    cases.push_back(c);
  }
  return cases;
}

/// Distance in units in the last place of `scale`; equal infinities are 0 apart.
double ulps(float a, float b, float scale) {
  if (a == b) return 0.0;
  const float size = std::max({std::abs(a), std::abs(b), std::abs(scale), std::numeric_limits<float>::min()});
  const double step = static_cast<double>(std::nextafter(size, std::numeric_limits<float>::infinity())) - size;
  return std::abs(static_cast<double>(a) - static_cast<double>(b)) / step;
}

class LensOnDevice : public support::GpuTest {};

TEST_F(LensOnDevice, LensFunctionsGiveTheSameValuesAsInCpp) {
  const auto cases = lensCases();
  const auto results = onDevice(cases);
  double vergenceUlps = 0.0, radiusUlps = 0.0;
  int differing = 0;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const auto& c = cases[i];
    const auto expected = shared::evaluateLensCase(c);
    const float product = c.lens.vergenceScale * c.depthBuffer;
    vergenceUlps = std::max(vergenceUlps, ulps(results[i].vergenceFromDepthBuffer, expected.vergenceFromDepthBuffer,
                                               std::max(std::abs(product), std::abs(c.lens.vergenceOffset))));
    radiusUlps = std::max(radiusUlps, ulps(results[i].signedCocRadius, expected.signedCocRadius, 0.0f));
    differing += results[i].signedCocRadius != expected.signedCocRadius ? 1 : 0;
    ASSERT_TRUE(std::isfinite(results[i].signedCocRadius)) << i;
    // No lens, or the focal plane: no blur, and no NaN.
    if (c.lens.cocScale == 0.0f || c.vergence == c.lens.focusVergence) {
      ASSERT_EQ(results[i].signedCocRadius, 0.0f) << i;
    }
  }
  std::printf("lens.h, %zu inputs: %.1f ulp (vergence), %.1f ulp (radius), %d radii differ\n", cases.size(),
              vergenceUlps, radiusUlps, differing);
  EXPECT_LE(vergenceUlps, 1.0);
  EXPECT_LE(radiusUlps, 1.0);
}

TEST_F(LensOnDevice, ApertureFunctionsGiveTheSameValuesAsInCpp) {
  const auto cases = apertureCases();
  const auto results = onDevice(cases);
  double radius = 0.0, weight = 0.0;
  int edges = 0, shut = 0;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const auto& c = cases[i];
    const auto expected = shared::evaluateLensCase(c);
    const auto& found = results[i];
    const double size = std::max(static_cast<double>(expected.radiusSquared), 1e-30);
    const double off =
        std::abs(static_cast<double>(found.radiusSquared) - static_cast<double>(expected.radiusSquared)) / size;
    radius = std::max(radius, off);
    const double ring =
        std::abs(static_cast<double>(found.ringWeight) - static_cast<double>(expected.ringWeight)) / (1.0 + 2.0 * size);
    weight = std::max(weight, ring);
    ASSERT_LE(ulps(found.reach, expected.reach, 0.0f), 3.0) << i;
    ASSERT_TRUE(found.vignette == 0.0f || found.vignette == 1.0f) << i;
    ASSERT_EQ(found.weight, found.ringWeight * found.vignette) << i;
    if (found.vignette == 0.0f) ++shut;
    if (found.vignette == expected.vignette) continue;
    // Only a point whose distance is 1 to the last digits may fall to either side.
    const double stretch = std::sqrt(static_cast<double>(c.shape.anamorphicRatio));
    const double k = static_cast<double>(c.shape.opticalVignetting);
    const double x = static_cast<double>(c.lensX) / stretch + k * static_cast<double>(c.placeX);
    const double y = static_cast<double>(c.lensY) * stretch + k * static_cast<double>(c.placeY);
    EXPECT_NEAR(x * x + y * y, 1.000001, 1e-6) << i;
    ++edges;
  }
  std::printf("aperture.h, %zu inputs: %.2g (radius²), %.2g (ring weight) relative, %d on the vignette's edge\n",
              cases.size(), radius, weight, edges);
  EXPECT_LE(radius, 1.5e-5);
  EXPECT_LE(weight, 1.5e-5);
  EXPECT_GT(shut, 1000) << "the vignette would be idle";
}

}  // namespace

}  // namespace lensgraph
