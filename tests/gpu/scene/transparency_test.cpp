// Alpha-blended surfaces: exact order per pixel, whatever order they are drawn in.
#include <gmock/gmock.h>

#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/test_scenes.h"

namespace lensgraph {

namespace {

using support::render;

constexpr int kWidth = 64, kHeight = 36;
constexpr float kTolerance = 1e-6f;

glm::vec3 over(const glm::vec4& top, const glm::vec3& below) {
  return glm::vec3(top) * top.a + below * (1.0f - top.a);
}

glm::vec3 pixelOf(const engine::FloatImage& picture, uint32_t x, uint32_t y) {
  const float* p = picture.pixel(x, y);
  return {p[0], p[1], p[2]};
}

void expectColor(const glm::vec3& actual, const glm::vec3& expected) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(actual[c], expected[c], kTolerance) << "channel " << c;
}

class Transparency : public support::GpuTest {};

TEST_F(Transparency, IntersectingPanesChangeOrderWhereTheyCross) {
  const glm::vec4 red(1.0f, 0.0f, 0.0f, 0.5f), green(0.0f, 1.0f, 0.0f, 0.25f);
  const glm::vec3 wall(0.2f, 0.4f, 0.8f);
  engine::Scene scene;
  support::addFacingQuad(scene, 6.0, 0.0, 0.0, 9.0, 9.0, support::addMaterial(scene, {wall, 1.0f}));
  // Red comes nearer to the right, green to the left; they cross in the middle.
  support::addQuad(scene, {glm::vec3(-3, -3, -5), {3, -3, -1}, {3, 3, -1}, {-3, 3, -5}},
                   support::addMaterial(scene, red));
  support::addQuad(scene, {glm::vec3(-3, -3, -1), {3, -3, -5}, {3, 3, -5}, {-3, 3, -1}},
                   support::addMaterial(scene, green));
  host::Renderer renderer(support::device(), scene, std::nullopt);
  const auto picture = render(renderer, support::smallShot(kWidth, kHeight), "pinhole").color;
  support::keepPicture(picture, "crossing_panes");
  expectColor(pixelOf(picture, 12, 18), over(green, over(red, wall)));
  expectColor(pixelOf(picture, 52, 18), over(red, over(green, wall)));
}

TEST_F(Transparency, ManyLayersGrowThePoolAndStayExact) {
  constexpr int kLayers = 23;
  engine::Scene scene;
  glm::vec3 expected(0.1f, 0.1f, 0.1f);
  std::vector<glm::vec4> colors;
  for (int i = 0; i < kLayers; ++i) colors.emplace_back(0.04f * i, 1.0f - 0.04f * i, (i % 3) * 0.5f, 0.1f + 0.03f * i);
  // Drawn in an order that is neither front to back nor back to front.
  for (int i = 0; i < kLayers; ++i) {
    const int layer = i * 7 % kLayers;
    support::addFacingQuad(scene, 8.0 - 0.3 * layer, 0.0, 0.0, 9.0, 9.0, support::addMaterial(scene, colors[layer]));
  }
  for (const auto& color : colors) expected = over(color, expected);
  host::Renderer renderer(support::device(), scene, std::nullopt);
  auto shot = support::smallShot(kWidth, kHeight);
  shot.background = {0.1f, 0.1f, 0.1f};
  const auto rendering = render(renderer, shot, "pinhole");
  EXPECT_EQ(rendering.statistics.transparentDropped, 0u);
  EXPECT_EQ(rendering.statistics.transparentNodes, uint32_t{kWidth * kHeight * kLayers});
  for (uint32_t y = 0; y < kHeight; y += 7) expectColor(pixelOf(rendering.color, 11, y), expected);
}

TEST_F(Transparency, OpaqueSurfacesHidePanesBehindThem) {
  engine::Scene scene;
  support::addFacingQuad(scene, 2.0, 0.0, 0.0, 9.0, 9.0, support::addMaterial(scene, {0.3f, 0.3f, 0.3f, 1.0f}));
  support::addFacingQuad(scene, 3.0, 0.0, 0.0, 9.0, 9.0, support::addMaterial(scene, {1.0f, 0.0f, 0.0f, 0.5f}));
  host::Renderer renderer(support::device(), scene, std::nullopt);
  const auto rendering = render(renderer, support::smallShot(kWidth, kHeight), "pinhole");
  expectColor(pixelOf(rendering.color, 20, 20), {0.3f, 0.3f, 0.3f});
  EXPECT_EQ(rendering.statistics.transparentNodes, 0u);
}

TEST_F(Transparency, EqualFragmentsAtEqualDepthAllCount) {
  const glm::vec4 pane(0.0f, 0.0f, 1.0f, 0.5f);
  engine::Scene scene;
  const auto material = support::addMaterial(scene, pane);
  for (int i = 0; i < 3; ++i) support::addFacingQuad(scene, 3.0, 0.0, 0.0, 9.0, 9.0, material);
  host::Renderer renderer(support::device(), scene, std::nullopt);
  auto shot = support::smallShot(kWidth, kHeight);
  shot.background = {1.0f, 0.0f, 0.0f};
  expectColor(pixelOf(render(renderer, shot, "pinhole").color, 5, 5),
              over(pane, over(pane, over(pane, glm::vec3(1.0f, 0.0f, 0.0f)))));
}

TEST_F(Transparency, ListsTooLongToSortAreCounted) {
  constexpr int kSide = 8;
  for (const int layers : {200, 300}) {
    engine::Scene scene;
    for (int i = 0; i < layers; ++i) {
      support::addFacingQuad(scene, 3.0 + 0.01 * i, 0.0, 0.0, 9.0, 9.0,
                             support::addMaterial(scene, {0.001f * i, 0.5f, 0.5f, 0.01f}));
    }
    host::Renderer renderer(support::device(), scene, std::nullopt);
    const auto rendering = render(renderer, support::smallShot(kSide, kSide), "pinhole");
    EXPECT_EQ(rendering.statistics.transparentUnsorted, layers == 200 ? 0u : uint32_t{kSide * kSide}) << layers;
  }
}

}  // namespace

}  // namespace lensgraph
