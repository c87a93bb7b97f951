// Which faces and which fragments of a surface are drawn, by every technique that draws scenes: sides, mirrored and flattened
// objects, and alpha masks at their cutoff.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/test_scenes.h"

namespace lensgraph {

namespace {

using engine::AlphaMode;
using engine::DrawnFaces;

constexpr int kWidth = 32, kHeight = 18;

/// A way of drawing a scene: techniques, and those of their parameters that draw otherwise.
struct Drawing {
  const char* name;
  const char* technique;
  passes::ParameterSet parameters = {};
  bool lit = false;
  friend void PrintTo(const Drawing& drawing, std::ostream* out) { *out << drawing.name; }
};

const Drawing kDrawings[] = {
    {"pinhole", "pinhole"},
    {"accumulation", "accumulation", {{"lensSamples", int64_t{16}}}},
    {"two_pass_filter", "two_pass_filter"},
    {"multilayer_filtering", "multilayer_filtering"},
    {"multilayer_filtering_all", "multilayer_filtering", {{"faces", std::string("all")}}},
    {"multilayer_filtering_front", "multilayer_filtering", {{"faces", std::string("front")}}},
    {"multiview_synthesis", "multiview_synthesis"},
    {"multiview_synthesis_view_dependent", "multiview_synthesis", {{"viewDependent", true}}, true},
};

class DrawnBy : public support::GpuTest, public testing::WithParamInterface<Drawing> {
 protected:
  /// Least and largest red of the picture; the background has 0, the surface 1.
  struct Reds {
    double least, largest;
    bool areDrawn(double red) const { return std::abs(least - red) < 2e-3 && std::abs(largest - red) < 2e-3; }
    friend void PrintTo(const Reds& reds, std::ostream* out) { *out << reds.least << "…" << reds.largest; }
  };

  Reds redsOf(const engine::Scene& scene, DrawnFaces faces = DrawnFaces::material) {
    EXPECT_THAT(engine::findProblems(scene), testing::IsEmpty());
    host::Renderer renderer(support::device(), scene, std::nullopt);
    shot.faces = faces;
    shot.shading = GetParam().lit ? host::Shading::lit : host::Shading::unlit;
    const auto picture = support::render(renderer, shot, GetParam().technique, GetParam().parameters).color;
    Reds reds{1e30, -1e30};
    for (std::size_t i = 0; i < picture.pixelCount(); ++i) {
      const double red = static_cast<double>(picture.samples[i * picture.channels]);
      reds = {std::min(reds.least, red), std::max(reds.largest, red)};
    }
    return reds;
  }

  host::Shot shot = support::smallShot(kWidth, kHeight);
};

/// A red quad at 2 m that fills every picture and faces the camera.
engine::Scene redQuad(AlphaMode mode = AlphaMode::opaque, float alpha = 1.0f) {
  engine::Scene scene;
  const uint32_t material = support::addMaterial(scene, {1.0f, 0.0f, 0.0f, alpha});
  scene.materials[material].alphaMode = mode;
  support::addFacingQuad(scene, 2.0, 0.0, 0.0, 9.0, 9.0, material);
  return scene;
}

engine::Scene seenFromBehind(engine::Scene scene) {
  for (auto& primitive : scene.primitives) {
    for (std::size_t i = 0; i < primitive.indices.size(); i += 3)
      std::swap(primitive.indices[i], primitive.indices[i + 1]);
  }
  return scene;
}

engine::Scene doubleSided(engine::Scene scene) {
  scene.materials[0].doubleSided = true;
  return scene;
}

engine::Scene scaled(engine::Scene scene, const glm::dvec3& factors) {
  scene.instances[0].worldFromObject = glm::scale(glm::dmat4(1.0), factors);
  return scene;
}

struct Surface {
  AlphaMode mode;
  float alpha;
};

TEST_P(DrawnBy, BackFacesWhereTheMaterialIsDoubleSidedOrBothAreAskedFor) {
  const bool frontOnly = std::string(GetParam().name).ends_with("_front");
  for (const auto& [mode, alpha] :
       {Surface{AlphaMode::opaque, 1.0f}, {AlphaMode::mask, 1.0f}, {AlphaMode::blend, 0.5f}}) {
    SCOPED_TRACE(static_cast<int>(mode));
    // An image technique takes a blended surface's depth from behind it, but its color all the same.
    const double red = static_cast<double>(alpha), backRed = frontOnly ? 0.0 : red;
    const auto front = redQuad(mode, alpha), back = seenFromBehind(front);
    EXPECT_TRUE(redsOf(front).areDrawn(red));
    EXPECT_TRUE(redsOf(back).areDrawn(0.0));
    EXPECT_TRUE(redsOf(doubleSided(front)).areDrawn(red));
    EXPECT_TRUE(redsOf(doubleSided(back)).areDrawn(backRed));
    EXPECT_TRUE(redsOf(back, DrawnFaces::both).areDrawn(backRed));
    EXPECT_TRUE(redsOf(front, DrawnFaces::both).areDrawn(red));
  }
}

TEST_P(DrawnBy, AMirroredObjectShowsTheSameSide) {
  const auto front = redQuad(), back = seenFromBehind(front);
  for (const glm::dvec3 mirror : {glm::dvec3(-1, 1, 1), glm::dvec3(1, -2, 1)}) {
    EXPECT_TRUE(redsOf(scaled(front, mirror)).areDrawn(1.0)) << mirror.x;
    EXPECT_TRUE(redsOf(scaled(back, mirror)).areDrawn(0.0)) << mirror.x;
  }
  const glm::dvec3 twice(-1, -1, 1);
  EXPECT_TRUE(redsOf(scaled(front, twice)).areDrawn(1.0));
  EXPECT_TRUE(redsOf(scaled(back, twice)).areDrawn(0.0));
}

// Beside objects that are not: the state of one draw does not reach the next.
TEST_P(DrawnBy, MirroredAndPlainObjectsOfOneMaterialStandTogether) {
  engine::Scene scene;
  const uint32_t material = support::addMaterial(scene, {1.0f, 0.0f, 0.0f, 1.0f});
  for (int i = 0; i < 8; ++i) {
    // Strips side by side, of which every other one is made by mirroring.
    const bool isMirrored = i % 2 == 0;
    const auto left = static_cast<float>(isMirrored ? 3 - i : i - 4);
    support::addQuad(scene, {glm::vec3(left, -3, -2), {left + 1, -3, -2}, {left + 1, 3, -2}, {left, 3, -2}}, material);
    if (isMirrored) scene.instances.back().worldFromObject = glm::scale(glm::dmat4(1.0), glm::dvec3(-1, 1, 1));
  }
  EXPECT_TRUE(redsOf(scene).areDrawn(1.0));
  EXPECT_TRUE(redsOf(seenFromBehind(scene)).areDrawn(0.0));
}

TEST_P(DrawnBy, AFlattenedObjectHasNoBack) {
  if (std::string(GetParam().name).ends_with("_front")) return;  // Leaves out by the rasterizer's front.
  auto front = redQuad();
  front.instances[0].worldFromObject = glm::scale(glm::translate(glm::dmat4(1.0), {0, 0, -2}), glm::dvec3(1, 1, 0));
  EXPECT_TRUE(redsOf(front).areDrawn(1.0));
  EXPECT_TRUE(redsOf(seenFromBehind(front)).areDrawn(1.0));
}

TEST_P(DrawnBy, TheCameraDecidesWhichSideIsSeen) {
  const auto quad = redQuad();
  for (const glm::dvec3 up : {glm::dvec3(0, 1, 0), glm::dvec3(0, -1, 0), glm::dvec3(1, 0.2, 0)}) {
    shot.camera.up = up;
    shot.camera.position = {0, 0, 0};
    EXPECT_TRUE(redsOf(quad).areDrawn(1.0));
    shot.camera.position = {0, 0, -4};
    shot.camera.target = {0, 0, 0};
    EXPECT_TRUE(redsOf(quad).areDrawn(0.0));
    shot.camera.target = {0, 0, -1};
  }
}

// The sheet's back is not the inside of the single-sided solid before it, whose own back is not drawn.
TEST_P(DrawnBy, ADoubleSidedSheetIsSeenBehindASingleSidedOne) {
  if (std::string(GetParam().technique) == "two_pass_filter") return;  // Sees nothing behind what it blurs.
  if (std::string(GetParam().name).ends_with("_front")) return;        // Draws no back.
  shot.lens.apertureRadius = 0.1;                                      // wide enough to look around the nearer one
  engine::Scene scene = doubleSided(seenFromBehind(redQuad()));
  support::addFacingQuad(scene, 0.3, 0.0, 0.0, 0.036, 9.0, support::addMaterial(scene, {1.0f, 0.0f, 0.0f, 1.0f}));
  EXPECT_TRUE(redsOf(scene).areDrawn(1.0));
}

TEST_P(DrawnBy, AnAlphaMaskIsDrawnAtItsCutoffAndNotBelow) {
  for (const float cutoff : {0.0f, 0.1f, 1.0f / 3.0f, 0.5f, 128.0f / 255.0f, 1.0f}) {
    auto scene = redQuad(AlphaMode::mask, cutoff);
    // Slanted, so that what is interpolated is divided by the depth.
    scene.primitives[0].positions = {{-9, -9, -1}, {9, -9, -1}, {9, 9, -9}, {-9, 9, -9}};
    scene.materials[0].alphaCutoff = cutoff;
    shot.camera.fovyDeg = 10.0;
    EXPECT_TRUE(redsOf(scene).areDrawn(1.0)) << cutoff;
    scene.materials[0].baseColorFactor.a = 0.996f * cutoff;
    if (cutoff > 0.0f) {
      EXPECT_TRUE(redsOf(scene).areDrawn(0.0)) << cutoff;
    }
    // The same alpha from the vertices and from a texture.
    scene.materials[0].baseColorFactor.a = 1.0f;
    scene.primitives[0].colors.assign(4, glm::vec4(1.0f, 1.0f, 1.0f, cutoff));
    EXPECT_TRUE(redsOf(scene).areDrawn(1.0)) << cutoff;
    if (cutoff != 128.0f / 255.0f) continue;
    scene.primitives[0].colors.clear();
    scene.primitives[0].uvs[0] = {{0, 0}, {7.3f, 0}, {7.3f, 5.1f}, {0, 5.1f}};
    std::vector<uint8_t> texels;
    for (int i = 0; i < 9; ++i) texels.insert(texels.end(), {255, 255, 255, 128});
    scene.images.push_back(
        {.name = "alpha", .width = 3, .height = 3, .rgba = texels, .encoding = engine::ColorEncoding::srgb});
    scene.textures.push_back({.image = 0});
    scene.materials[0].baseColorTexture.texture = 0;
    EXPECT_TRUE(redsOf(scene).areDrawn(1.0)) << "texture";
  }
}

INSTANTIATE_TEST_SUITE_P(Each, DrawnBy, testing::ValuesIn(kDrawings),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace

}  // namespace lensgraph
