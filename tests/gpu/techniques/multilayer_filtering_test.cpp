// The multi-layer filtering, detail by detail: each test fails when its detail is taken out.
#include <gmock/gmock.h>

#include <cmath>

#include "engine/metrics/metrics.h"
#include "multilayer_filtering_fixture.h"
#include "tests/support/gpu/spot.h"

namespace lensgraph {

namespace {

using namespace multilayer_test;

/// A plane through the focal plane that fills the picture, of constant colour; far behind it everything is magenta.
engine::Scene slantedPlane(double slope) {
  engine::Scene scene;
  const uint32_t wall = support::addMaterial(scene, {kColor, 1.0f});
  const auto depth = [&](double x) { return static_cast<float>(1.0 / (0.5 + slope * x)); };  // vergence is linear
  const auto corner = [&](double x, double y) {
    return glm::vec3(static_cast<float>(x) * depth(x), static_cast<float>(y) * depth(x), -depth(x));
  };
  support::addQuad(scene, {corner(-0.8, -1), corner(0.8, -1), corner(0.8, 1), corner(-0.8, 1)}, wall);
  support::addFacingQuad(scene, 90.0, 0.0, 0.0, 199.0, 199.0, support::addMaterial(scene, {9, 0, 9, 1}));
  return scene;
}

// At every level and configuration, and across levels: nothing of what is behind shows through.
TEST_F(MultilayerFiltering, OpaqueSurfacesStayOpaque) {
  auto shot = support::smallShot(112, 54);
  shot.camera.fovyDeg = 24.0;
  shot.background = {9.0f, 0.0f, 9.0f};
  const std::vector<ParameterSet> variants = {{},
                                              {{"levelMatch", std::string("diameter")}},
                                              {{"blend", std::string("additive")}},
                                              {{"interpolateLevels", false}},
                                              {{"bilinear", false}},
                                              {{"truncation", false}}};
  for (const double slope : {0.2, 0.6}) {
    host::Renderer renderer(support::device(), slantedPlane(slope), std::nullopt);
    for (const double aperture : {0.02, 0.15}) {
      shot.lens.apertureRadius = aperture;
      for (const auto& configuration : configurations()) {
        for (const auto& variant : variants) {
          const auto parameters = with(configuration, variant);
          const auto image = render(renderer, shot, kName, parameters).color;
          EXPECT_LE(distanceFrom(image, kColor), 1e-3)
              << "slope " << slope << ", aperture " << aperture << described(parameters);
        }
      }
    }
  }
}

// A bar in front of the focal plane takes away as much light as it covers, wherever its blur spreads that to, and its
// silhouette falls off evenly.
TEST_F(MultilayerFiltering, SilhouettesBecomePartiallyTransparent) {
  auto shot = support::smallShot(160, 40);
  shot.background = {1.0f, 1.0f, 1.0f};
  shot.lens.apertureRadius = 0.1;
  const double width = 6.0;  // px
  for (const double depth : {1.2, 1.6, 4.0}) {
    engine::Scene scene;
    const double half = 0.5 * width * depth / support::pixelsPerTangent(shot);
    support::addFacingQuad(scene, depth, 0.0, 0.0, half, 9.0, support::addMaterial(scene, {0.0f, 0.0f, 0.0f, 1.0f}));
    for (const auto& configuration : configurations()) {
      const auto image = picture(scene, shot, configuration);
      double covered = 0.0;
      bool falls = true;
      for (uint32_t x = 0; x < image.width; ++x) {
        covered += 1.0 - double(image.pixel(x, 20)[0]);
        if (x >= 80 && x + 1 < image.width) falls &= image.pixel(x + 1, 20)[0] >= image.pixel(x, 20)[0] - 1e-3f;
      }
      // Weights of levels differ within the blur of coarse ones by what the bar is wide.
      EXPECT_NEAR(covered, width, 0.1) << depth << described(configuration);
      EXPECT_TRUE(falls) << depth << described(configuration);
      const double expected = std::abs(support::thinLensRadius(shot, depth));
      const float middle = image.pixel(80, 20)[0];
      EXPECT_TRUE(expected > 0.5 * width ? middle > 0.02f : true) << depth << described(configuration);
    }
  }
}

// Stack steps are off-centre by half a tap each; their sum is undone when levels are looked up. The light lies evenly about a
// corner of the coarsest cells, so that none of a mip map's own coarseness moves it.
TEST_F(MultilayerFiltering, LevelsDoNotDrift) {
  auto shot = support::smallShot(96, 96);
  shot.lens.apertureRadius = 0.2;
  for (const double depth : {1.93, 1.8, 1.5, 1.3, 2.2, 3.0, 5.0}) {
    const auto scene = support::lightScene(depth, 4.0, support::pixelsPerTangent(shot));
    for (const auto& configuration : configurations()) {
      const auto spot = support::measureSpot(picture(scene, shot, configuration));
      EXPECT_NEAR(spot.x, 48.0, 0.01) << depth << described(configuration);
      EXPECT_NEAR(spot.y, 48.0, 0.01) << depth << described(configuration);
    }
  }
}

// The blur of a light has the aperture's second moment, whatever the configuration, and keeps the light.
TEST_F(MultilayerFiltering, BlurIsAsWideAsTheCircleOfConfusion) {
  auto shot = support::smallShot(128, 128);
  shot.lens.apertureRadius = 0.2;
  for (const double depth : {1.9, 1.75, 1.5, 1.25, 2.5, 4.0, 9.0}) {
    const double radius = std::abs(support::thinLensRadius(shot, depth));
    for (const auto& configuration :
         {ParameterSet{}, ParameterSet{{"mipSteps", int64_t{0}}}, ParameterSet{{"mipSteps", int64_t{2}}},
          ParameterSet{{"antialiasing", std::string("2x2")}}}) {
      // How a light lies on a mip map's cells widens or narrows its blur: the mean over all ways is what counts.
      double variance = 0.0;
      for (int offset = 0; offset < 4; ++offset) {
        const auto scene = support::lightScene(depth, 4.0, support::pixelsPerTangent(shot), offset, offset);
        const auto spot = support::measureSpot(picture(scene, shot, configuration));
        variance += 0.125 * (spot.varianceX + spot.varianceY);
        EXPECT_NEAR(spot.flux, 1600.0, 16.0) << depth << described(configuration);
      }
      // The light's square adds 16/12, less where pixels see points; the pixel adds 1/12 where there is blur.
      const double expected = std::sqrt(0.25 * radius * radius + 16.0 / 12.0);
      EXPECT_NEAR(std::sqrt(variance), expected, 0.03 * expected) << depth << described(configuration);
    }
  }
}

/// The largest change of slope along the picture's rows: of what stands beside an edge that recedes through focus.
double largestKink(const engine::FloatImage& image) {
  double largest = 0.0;
  for (uint32_t y = 20; y < image.height - 20; ++y) {
    for (uint32_t x = 9; x + 9 < image.width; ++x) {
      const auto value = [&](uint32_t at) { return double(image.pixel(at, y)[0]); };
      largest = std::max(largest, std::abs(value(x + 1) - 2.0 * value(x) + value(x - 1)));
    }
  }
  return largest;
}

// A plane that recedes through focus, dark above and bright below: its edge's blur narrows and widens again, without steps
// where one level takes over from another.
TEST_F(MultilayerFiltering, LevelsBlendWithoutSteps) {
  engine::Scene scene;
  const auto corner = [](double x, double y) {
    const double depth = 1.0 / (0.5 + 0.5 * x);
    return glm::vec3(static_cast<float>(x * depth), static_cast<float>(y * depth), static_cast<float>(-depth));
  };
  support::addQuad(scene, {corner(-0.95, 0), corner(0.95, 0), corner(0.95, 1), corner(-0.95, 1)},
                   support::addMaterial(scene, {0.0f, 0.0f, 0.0f, 1.0f}));
  support::addQuad(scene, {corner(-0.95, -1), corner(0.95, -1), corner(0.95, 0), corner(-0.95, 0)},
                   support::addMaterial(scene, {1.0f, 1.0f, 1.0f, 1.0f}));
  auto shot = support::smallShot(256, 64);
  shot.camera.fovyDeg = 22.0;
  shot.lens.apertureRadius = 0.12;
  host::Renderer renderer(support::device(), scene, std::nullopt);
  const auto reference =
      render(renderer, shot, "accumulation", {{"lensSamples", int64_t{1024}}, {"viewsPerFrame", int64_t{64}}}).color;
  const auto image = render(renderer, shot, kName, {}).color;
  const auto stepped = render(renderer, shot, kName, {{"interpolateLevels", false}}).color;
  support::keepPicture(image, "multilayer_receding");
  support::keepPicture(stepped, "multilayer_receding_stepped");
  support::keepPicture(reference, "multilayer_receding_reference");
  std::printf("largest second difference: %.4f, without interpolation %.4f, accumulation %.4f\n", largestKink(image),
              largestKink(stepped), largestKink(reference));
  EXPECT_LE(largestKink(image), 0.04);
  EXPECT_LE(largestKink(image), 2.0 * largestKink(reference));
  EXPECT_GE(largestKink(stepped), 0.05);
}

// Panes before, at and behind focus, one behind another, before a wall: exactly what they let through, wherever they are.
TEST_F(MultilayerFiltering, PanesCoverWhatIsBehindThem) {
  const glm::vec3 wall(0.2f, 0.4f, 0.8f), red(1.0f, 0.0f, 0.0f), green(0.0f, 1.0f, 0.0f);
  const glm::vec3 expected = 0.25f * green + 0.75f * (0.5f * red + 0.5f * wall);
  auto shot = support::smallShot(64, 36);
  for (const double second : {1.2, 1.99, 2.0, 2.05, 3.0}) {
    for (const double first : {0.9, 1.15, 1.6, 1.95, 2.0, 2.02, 2.9}) {
      if (first >= second) continue;
      engine::Scene scene;
      support::addFacingQuad(scene, 6.0, 0.0, 0.0, 19.0, 19.0, support::addMaterial(scene, {wall, 1.0f}));
      support::addFacingQuad(scene, second, 0.0, 0.0, 9.0, 9.0, support::addMaterial(scene, {red, 0.5f}));
      support::addFacingQuad(scene, first, 0.0, 0.0, 9.0, 9.0, support::addMaterial(scene, {green, 0.25f}));
      host::Renderer renderer(support::device(), scene, std::nullopt);
      for (const double aperture : {0.005, 0.02, 0.1}) {
        shot.lens.apertureRadius = aperture;
        EXPECT_LE(distanceFrom(render(renderer, shot, kName, {}).color, expected), 2e-3)
            << first << " " << second << " " << aperture;
      }
    }
  }
}

// Tilted panes that cross the focal plane and levels' borders.
TEST_F(MultilayerFiltering, TiltedPanesCoverWhatIsBehindThem) {
  const glm::vec3 wall(0.2f, 0.4f, 0.8f), red(1.0f, 0.0f, 0.0f), green(0.0f, 1.0f, 0.0f);
  const glm::vec3 expected = 0.25f * green + 0.75f * (0.5f * red + 0.5f * wall);
  engine::Scene scene;
  support::addFacingQuad(scene, 6.0, 0.0, 0.0, 19.0, 19.0, support::addMaterial(scene, {wall, 1.0f}));
  const auto tilted = [&](float depth, uint32_t material) {
    support::addQuad(
        scene,
        {glm::vec3(-9, -9, -depth - 0.8f), {9, -9, -depth - 0.8f}, {9, 9, -depth + 0.8f}, {-9, 9, -depth + 0.8f}},
        material);
  };
  tilted(3.5f, support::addMaterial(scene, {red, 0.5f}));
  tilted(2.0f, support::addMaterial(scene, {green, 0.25f}));
  auto shot = support::smallShot(64, 64);
  shot.lens.apertureRadius = 0.05;
  EXPECT_LE(distanceFrom(picture(scene, shot), expected), 2e-3);
}

// The paper's artefact (§7, fig. 12): where three layers meet, additive blending over-estimates the opacity of the first two
// and the third is lost. Blending over shows it as accumulation does.
TEST_F(MultilayerFiltering, ThreeLayersMeetAsInTheReference) {
  engine::Scene scene;
  support::addFacingQuad(scene, 8.0, 0.0, 0.0, 19.0, 19.0, support::addMaterial(scene, {0.1f, 0.2f, 1.0f, 1.0f}));
  for (int i = -9; i < 9; ++i) {
    support::addFacingQuad(scene, 4.0, 0.5 * i, 0.0, 0.13, 9.0, support::addMaterial(scene, {1.0f, 0.8f, 0.1f, 1.0f}));
    support::addFacingQuad(scene, 1.0, 0.0, 0.12 * i, 9.0, 0.03, support::addMaterial(scene, {0.0f, 0.0f, 0.0f, 1.0f}));
  }
  auto shot = support::smallShot(128, 72);
  shot.lens.apertureRadius = 0.12;
  host::Renderer renderer(support::device(), scene, std::nullopt);
  const auto reference =
      render(renderer, shot, "accumulation", {{"lensSamples", int64_t{512}}, {"viewsPerFrame", int64_t{64}}}).color;
  const auto over = render(renderer, shot, kName, {}).color;
  const auto additive = render(renderer, shot, kName, {{"blend", std::string("additive")}}).color;
  support::keepPicture(over, "multilayer_three_over");
  support::keepPicture(additive, "multilayer_three_additive");
  support::keepPicture(reference, "multilayer_three_reference");
  const double ofOver = engine::compareImages(over, reference).psnr;
  const double ofAdditive = engine::compareImages(additive, reference).psnr;
  std::printf("three layers: over %.2f dB, additive %.2f dB\n", ofOver, ofAdditive);
  EXPECT_GE(ofOver, ofAdditive + 3.0);
}

TEST_F(MultilayerFiltering, TruncationChangesLittle) {
  host::Renderer renderer(support::device(), support::layeredScene(), std::nullopt);
  auto shot = support::smallShot(160, 90);
  shot.lens.apertureRadius = 0.06;
  for (const auto& configuration : configurations()) {
    const auto truncated = render(renderer, shot, kName, configuration);
    const auto full = render(renderer, shot, kName, with(configuration, {{"truncation", false}}));
    EXPECT_GE(engine::compareImages(truncated.color, full.color).psnr, 50.0) << described(configuration);
    EXPECT_LT(truncated.statistics.listFragments, full.statistics.listFragments) << described(configuration);
  }
}

// The order in which fragments arrive, equal depths included, changes no bit.
TEST_F(MultilayerFiltering, OrderOfDrawingChangesNothing) {
  const auto sceneIn = [](bool reversed) {
    engine::Scene scene = support::layeredScene();
    for (int i = 0; i < 12; ++i) {  // coplanar, in colours of their own
      const auto shade = static_cast<float>(i) / 12.0f;
      support::addFacingQuad(scene, 3.0, 0.03 * i, 0.02 * i, 0.4, 0.3,
                             support::addMaterial(scene, {shade, 1.0f - shade, 0.5f, i % 3 == 0 ? 0.5f : 1.0f}));
    }
    if (reversed) std::ranges::reverse(scene.instances);
    return scene;
  };
  const auto shot = support::smallShot(96, 54);
  for (const int64_t length : {1, 4, 16}) {
    EXPECT_TRUE(picture(sceneIn(false), shot, {{"listLength", length}}).samples ==
                picture(sceneIn(true), shot, {{"listLength", length}}).samples)
        << length;
  }
}

/// A closed box, its faces wound outwards.
void addBox(engine::Scene& scene, const glm::vec3& low, const glm::vec3& high, uint32_t material) {
  const auto at = [&](int x, int y, int z) {
    return glm::vec3(x != 0 ? high.x : low.x, y != 0 ? high.y : low.y, z != 0 ? high.z : low.z);
  };
  support::addQuad(scene, {at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1)}, material);
  support::addQuad(scene, {at(1, 0, 0), at(0, 0, 0), at(0, 1, 0), at(1, 1, 0)}, material);
  support::addQuad(scene, {at(0, 0, 0), at(0, 0, 1), at(0, 1, 1), at(0, 1, 0)}, material);
  support::addQuad(scene, {at(1, 0, 1), at(1, 0, 0), at(1, 1, 0), at(1, 1, 1)}, material);
  support::addQuad(scene, {at(0, 1, 1), at(1, 1, 1), at(1, 1, 0), at(0, 1, 0)}, material);
  support::addQuad(scene, {at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1)}, material);
}

// The far faces of a solid are not seen, and do not make its blurred silhouette more opaque. Sheets' both sides are.
TEST_F(MultilayerFiltering, InsidesOfSolidsAreLeftOut) {
  engine::Scene box;
  addBox(box, {-0.05f, -0.05f, -1.0f}, {0.05f, 0.05f, -0.8f}, support::addMaterial(box, {0.0f, 0.0f, 0.0f, 1.0f}));
  auto shot = support::smallShot(96, 54);
  shot.faces = engine::DrawnFaces::both;
  shot.background = {1.0f, 1.0f, 1.0f};
  shot.lens.apertureRadius = 0.08;
  host::Renderer renderer(support::device(), box, std::nullopt);
  const auto reference =
      render(renderer, shot, "accumulation", {{"lensSamples", int64_t{512}}, {"viewsPerFrame", int64_t{64}}}).color;
  const auto psnrOf = [&](const char* faces) {
    return engine::compareImages(render(renderer, shot, kName, {{"faces", std::string(faces)}}).color, reference).psnr;
  };
  std::printf("solid: outer %.2f dB, front %.2f dB, all %.2f dB\n", psnrOf("outer"), psnrOf("front"), psnrOf("all"));
  EXPECT_GE(psnrOf("outer"), psnrOf("all") + 3.0);
  EXPECT_NEAR(psnrOf("outer"), psnrOf("front"), 0.01);

  // A mirrored object's winding is turned round: the same box, made by mirroring another.
  engine::Scene mirrored;
  addBox(mirrored, {-0.05f, -0.05f, -1.0f}, {0.05f, 0.05f, -0.8f},
         support::addMaterial(mirrored, {0.0f, 0.0f, 0.0f, 1.0f}));
  for (auto& instance : mirrored.instances) instance.worldFromObject[0][0] = -1.0;
  for (const char* faces : {"outer", "front", "all"}) {
    const auto straight = render(renderer, shot, kName, {{"faces", std::string(faces)}}).color;
    EXPECT_GE(engine::compareImages(picture(mirrored, shot, {{"faces", std::string(faces)}}), straight).psnr, 60.0)
        << faces;
  }

  engine::Scene sheet;  // seen from behind
  support::addQuad(sheet, {glm::vec3(-9, -9, -3), {-9, 9, -3}, {9, 9, -3}, {9, -9, -3}},
                   support::addMaterial(sheet, {kColor, 1.0f}));
  EXPECT_LE(distanceFrom(picture(sheet, shot), kColor), 1e-3);
  EXPECT_GT(distanceFrom(picture(sheet, shot, {{"faces", std::string("front")}}), kColor), 0.5);
}

// A bar beyond the picture blurs into it: with a border it is there, without it is lost.
TEST_F(MultilayerFiltering, TheBorderHoldsWhatBlursIntoThePicture) {
  engine::Scene scene;
  support::addFacingQuad(scene, 2.0, 0.0, 0.0, 9.0, 9.0, support::addMaterial(scene, {0.2f, 0.2f, 0.2f, 1.0f}));
  auto shot = support::smallShot(96, 54);
  shot.lens.apertureRadius = 0.1;
  const double edge = 0.5 * 96 / support::pixelsPerTangent(shot);
  support::addFacingQuad(scene, 0.5, 0.5 * edge + 0.051, 0.0, 0.05, 9.0, support::addMaterial(scene, {5, 1, 1, 1}));
  host::Renderer renderer(support::device(), scene, std::nullopt);
  const auto reference =
      render(renderer, shot, "accumulation", {{"lensSamples", int64_t{512}}, {"viewsPerFrame", int64_t{64}}}).color;
  const auto psnrOf = [&](double border) {
    return engine::compareImages(render(renderer, shot, kName, {{"border", border}}).color, reference).psnr;
  };
  EXPECT_GE(psnrOf(1.0), psnrOf(0.0) + 8.0);
}

}  // namespace

}  // namespace lensgraph
