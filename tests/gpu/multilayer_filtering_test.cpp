// The multi-layer filtering, detail by detail: each test fails when its detail is taken out.
#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "engine/metrics.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/spot.h"
#include "tests/support/gpu/test_scenes.h"

namespace {

using passes::ParameterSet;
using support::render;

constexpr const char* kName = "multilayer_filtering";

const glm::vec3 kColor(0.25f, 3.0f, 0.05f);

ParameterSet with(ParameterSet set, const ParameterSet& more) {
  for (const auto& [name, value] : more) set[name] = value;
  return set;
}

/// The paper's filter configurations, and ours.
std::vector<ParameterSet> configurations() {
  const auto steps = [](int64_t mip, int64_t stack) -> ParameterSet {
    return {{"mipSteps", mip}, {"stackSteps", stack}};
  };
  return {{},          steps(1, 3),  steps(2, 2), steps(4, 0), steps(0, -1), steps(2, -1),
          steps(0, 4), steps(13, 0), {{"antialiasing", std::string("2x2")}}};
}

class MultilayerFiltering : public support::GpuTest {
 protected:
  host::Rendering rendering(const engine::Scene& scene, const host::Shot& shot, const ParameterSet& parameters = {}) {
    host::Renderer renderer(support::device(), scene, std::nullopt);
    return render(renderer, shot, kName, parameters);
  }
  engine::FloatImage picture(const engine::Scene& scene, const host::Shot& shot, const ParameterSet& parameters = {}) {
    return rendering(scene, shot, parameters).color;
  }
};

/// A plane through the focal plane that fills the picture, of constant colour; far behind it everything is magenta.
engine::Scene slantedPlane(double slope) {
  engine::Scene scene;
  const uint32_t wall = support::addMaterial(scene, {kColor, 1.0f});
  const auto depth = [&](double x) { return static_cast<float>(1.0 / (0.5 + slope * x)); };  // vergence is linear
  const auto corner = [&](double x, double y) {
    return glm::vec3(static_cast<float>(x) * depth(x), static_cast<float>(y) * depth(x), -depth(x));
  };
  support::addQuad(scene, {corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)}, wall);
  support::addFacingQuad(scene, 90.0, 0.0, 0.0, 199.0, 199.0, support::addMaterial(scene, {9, 0, 9, 1}));
  return scene;
}

double distanceFrom(const engine::FloatImage& picture, const glm::vec3& color) {
  double largest = 0.0;
  for (std::size_t i = 0; i < picture.pixelCount(); ++i) {
    for (int c = 0; c < 3; ++c) {
      largest = std::max(largest, std::abs(double(picture.samples[4 * i + c]) / double(color[c]) - 1.0));
    }
  }
  return largest;
}

TEST_F(MultilayerFiltering, OpaqueSurfacesStayOpaque) {
  auto shot = support::smallShot(160, 90);
  shot.background = {9.0f, 0.0f, 9.0f};
  for (const double slope : {0.02, 0.2, 0.45}) {
    for (const double aperture : {0.01, 0.05, 0.2}) {
      shot.lens.apertureRadius = aperture;
      for (const auto& configuration : configurations()) {
        for (const auto& variant :
             {ParameterSet{}, ParameterSet{{"levelMatch", std::string("diameter")}}, ParameterSet{{"blend", std::string("additive")}},
              ParameterSet{{"interpolateLevels", false}}, ParameterSet{{"bilinear", false}}, ParameterSet{{"truncation", false}}}) {
          const auto image = picture(slantedPlane(slope), shot, with(configuration, variant));
          const double d = distanceFrom(image, kColor);
          if (d > 1e-3) {
            std::printf("slope %g aperture %g:", slope, aperture);
            for (const auto& [n, v] : with(configuration, variant)) std::printf(" %s=%s", n.c_str(), passes::toString(v).c_str());
            std::printf(" %.5f\n", d);
          }
        }
      }
    }
  }
}

// Panes before, at and behind focus, one behind another, before a wall: exactly what they let through, wherever they are.
TEST_F(MultilayerFiltering, PanesCoverWhatIsBehindThem) {
  const glm::vec3 wall(0.2f, 0.4f, 0.8f), red(1.0f, 0.0f, 0.0f), green(0.0f, 1.0f, 0.0f);
  for (const double second : {1.2, 1.99, 2.0, 2.05, 3.0}) {
    for (const double first : {0.9, 1.0, 1.15, 1.6, 1.95, 1.98, 2.0, 2.02, 2.9}) {
      if (first >= second) continue;
      engine::Scene scene;
      support::addFacingQuad(scene, 6.0, 0.0, 0.0, 19.0, 19.0, support::addMaterial(scene, {wall, 1.0f}));
      support::addFacingQuad(scene, second, 0.0, 0.0, 9.0, 9.0, support::addMaterial(scene, {red, 0.5f}));
      support::addFacingQuad(scene, first, 0.0, 0.0, 9.0, 9.0, support::addMaterial(scene, {green, 0.25f}));
      const glm::vec3 expected = 0.25f * green + 0.75f * (0.5f * red + 0.5f * wall);
      auto shot = support::smallShot(64, 36);
      for (const double aperture : {0.005, 0.02, 0.1}) {
        shot.lens.apertureRadius = aperture;
        const auto image = picture(scene, shot);
        EXPECT_LE(distanceFrom(image, expected), 2e-3)
            << first << " " << second << " " << aperture << ": " << image.samples[0] << " " << image.samples[1] << " " << image.samples[2];
      }
    }
  }
}

TEST_F(MultilayerFiltering, Probe) {
  auto shot = support::smallShot(160, 90);
  shot.background = {9.0f, 0.0f, 9.0f};
  shot.lens.apertureRadius = 0.2;
  for (const auto& more : {ParameterSet{}, {{"linkDistance", 1.0}}, {{"epsilon", 1.0}}, {{"truncation", false}}}) {
  const auto image = picture(slantedPlane(0.45), shot, with({{"mipSteps", int64_t{4}}, {"stackSteps", int64_t{0}}, {"levelMatch", std::string("diameter")}}, more));
  std::printf("set\n");
  for (int x = 0; x < 160; ++x) for (int y = 0; y < 90; y += 1) {
    const double c = support::pixelsPerTangent(shot) * 0.2 * (0.5 - (0.5 + 0.45 * (x + 0.5 - 80) / support::pixelsPerTangent(shot)));
    const double leak = (image.pixel(x, y)[2] - 0.05) / 8.95;
    if (leak > 5e-4 && y % 10 == 0) std::printf("%d %d c=%.2f leak %.4f\n", x, y, c, leak);
  }
  }
}

}  // namespace
