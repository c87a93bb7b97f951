// What a ray sees: alpha modes, faces, depth, textures, light.
#include <gmock/gmock.h>

#include "traced.h"

namespace lensgraph::test {
namespace {

using engine::AlphaMode;
using engine::DrawnFaces;

class RayTracedSurfaces : public testing::Test {
 protected:
  RayTracedSurfaces() {
    view_.lens.apertureRadius = 0.0;
    view_.background = {0.25f, 0.5f, 0.75f};
  }
  glm::vec3 center(const engine::Scene& scene) const {
    const auto picture = trace(scene, view_, 16);
    const float* p = picture.color.pixel(4, 4);
    return {p[0], p[1], p[2]};
  }
  static void expectNear(const glm::vec3& a, const glm::vec3& b) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], 1e-5f) << i;
  }
  engine::RayTracedView view_ = smallView(8, 8);
};

TEST_F(RayTracedSurfaces, NothingHitIsTheBackgroundAndHasNoDepth) {
  expectNear(center({}), {0.25f, 0.5f, 0.75f});
  EXPECT_EQ(trace({}, view_, 1).depth.pixel(4, 4)[0], engine::kNoDepth);
}

TEST_F(RayTracedSurfaces, BlendedLayersLieOverEachOtherInTheOrderOfTheirDepths) {
  const glm::vec4 red(1.0f, 0.0f, 0.0f, 0.5f), green(0.0f, 1.0f, 0.0f, 0.25f);
  const glm::vec3 expected = glm::vec3(red) * 0.5f + 0.5f * (glm::vec3(green) * 0.25f + 0.75f * glm::vec3(0.2f));
  for (const bool redFirst : {true, false}) {
    engine::Scene scene;
    const auto add = [&](const glm::vec4& color, double depth) {
      addQuad(scene, depth, 0, 0, 3, 3, addMaterial(scene, color));
    };
    add({0.9f, 0.9f, 0.9f, 0.9f}, 5.0);  // Hidden.
    if (redFirst) add(red, 1.0);
    add(green, 2.0);
    if (!redFirst) add(red, 1.0);
    add({0.2f, 0.2f, 0.2f, 1.0f}, 3.0);
    expectNear(center(scene), expected);
    EXPECT_NEAR(trace(scene, view_, 1).depth.pixel(4, 4)[0], 3.0f, 1e-5f) << "blended surfaces have no depth";
  }
}

// Pixel centers lie on the diagonal that the quad's triangles share: there must be one surface, not two.
TEST_F(RayTracedSurfaces, ABlendedQuadCountsOnceAlongItsDiagonal) {
  engine::Scene scene;
  addQuad(scene, 2.0, 0, 0, 3, 3, addMaterial(scene, {1.0f, 1.0f, 1.0f, 0.5f}));
  const auto picture = trace(scene, view_, 1, engine::PixelFilter::point).color;
  for (uint32_t y = 0; y < 8; ++y) {
    for (uint32_t x = 0; x < 8; ++x) EXPECT_NEAR(picture.pixel(x, y)[0], 0.5f + 0.5f * 0.25f, 1e-5f) << x << " " << y;
  }
}

TEST_F(RayTracedSurfaces, AMaskShowsWhatIsBehindItsHoles) {
  engine::Scene scene;
  const uint32_t leaf = addMaterial(scene, {1.0f, 1.0f, 1.0f, 1.0f});
  scene.images.push_back({.name = "left half", .width = 2, .height = 1, .rgba = {255, 255, 255, 255, 0, 0, 0, 0}});
  scene.textures.push_back({.image = 0,
                            .wrapS = engine::Wrap::clampToEdge,
                            .wrapT = engine::Wrap::clampToEdge,
                            .magFilter = engine::Filter::nearest});
  scene.materials[leaf].alphaMode = AlphaMode::mask;
  scene.materials[leaf].baseColorTexture.texture = 0;
  addQuad(scene, 1.0, 0, 0, 3, 3, leaf);
  addQuad(scene, 2.0, 0, 0, 3, 3, addMaterial(scene, {0.0f, 1.0f, 0.0f, 1.0f}));
  const auto picture = trace(scene, view_, 4);
  EXPECT_NEAR(picture.color.pixel(1, 4)[0], 1.0f, 1e-6f);
  EXPECT_NEAR(picture.depth.pixel(1, 4)[0], 1.0f, 1e-6f);
  EXPECT_NEAR(picture.color.pixel(6, 4)[0], 0.0f, 1e-6f);
  EXPECT_NEAR(picture.depth.pixel(6, 4)[0], 2.0f, 1e-6f);
}

TEST_F(RayTracedSurfaces, BackFacesOfSingleSidedMaterialsAreDrawnOnlyOnDemand) {
  engine::Scene scene;
  const uint32_t material = addMaterial(scene, {1.0f, 1.0f, 1.0f, 1.0f});
  addQuad(scene, 2.0, 0, 0, 3, 3, material);
  const glm::vec3 white(1.0f), background(0.25f, 0.5f, 0.75f);
  view_.viewpoint.faces = DrawnFaces::material;
  expectNear(center(scene), white);
  // A mirrored object shows the same side; one with corners the other way round its back.
  scene.instances[0].worldFromObject[0][0] = -1.0;
  expectNear(center(scene), white);
  scene.primitives[0].indices = {0, 2, 1, 0, 3, 2};
  expectNear(center(scene), background);
  scene.instances[0].worldFromObject[0][0] = 1.0;
  expectNear(center(scene), background);
  view_.viewpoint.faces = DrawnFaces::both;
  expectNear(center(scene), white);
  view_.viewpoint.faces = DrawnFaces::material;
  scene.materials[material].doubleSided = true;
  expectNear(center(scene), white);
}

TEST_F(RayTracedSurfaces, NothingNearerThanTheNearPlaneIsDrawn) {
  engine::Scene scene;
  addQuad(scene, 1.0, 0, 0, 3, 3, addMaterial(scene, {1.0f, 0.0f, 0.0f, 1.0f}));
  addQuad(scene, 2.0, 0, 0, 3, 3, addMaterial(scene, {0.0f, 1.0f, 0.0f, 1.0f}));
  view_.camera.nearPlane = 1.5;
  expectNear(center(scene), {0.0f, 1.0f, 0.0f});
}

TEST_F(RayTracedSurfaces, TexturesAreFilteredInLinearLightAndWrapAsTheySay) {
  engine::Scene scene;
  const uint32_t material = addMaterial(scene, {1.0f, 1.0f, 1.0f, 1.0f});
  scene.images.push_back({.name = "black and white",
                          .width = 2,
                          .height = 1,
                          .rgba = {0, 0, 0, 255, 255, 255, 255, 255},
                          .encoding = engine::ColorEncoding::srgb});
  scene.textures.push_back({.image = 0});
  scene.materials[material].baseColorTexture.texture = 0;
  scene.materials[material].baseColorTexture.scale = {0.0f, 0.0f};
  addQuad(scene, 1.0, 0, 0, 3, 3, material);
  const auto at = [&](float u, engine::Wrap wrap) {
    scene.textures[0].wrapS = wrap;
    scene.materials[material].baseColorTexture.offset = {u, 0.5f};
    return center(scene).r;
  };
  EXPECT_NEAR(at(0.25f, engine::Wrap::repeat), 0.0f, 1e-5f);
  EXPECT_NEAR(at(0.5f, engine::Wrap::repeat), 0.5f, 1e-5f);
  EXPECT_NEAR(at(0.75f, engine::Wrap::repeat), 1.0f, 1e-5f);
  EXPECT_NEAR(at(1.25f, engine::Wrap::repeat), 0.0f, 1e-5f);
  EXPECT_NEAR(at(1.25f, engine::Wrap::mirroredRepeat), 1.0f, 1e-5f);
  EXPECT_NEAR(at(1.25f, engine::Wrap::clampToEdge), 1.0f, 1e-5f);
  EXPECT_NEAR(at(0.0f, engine::Wrap::repeat), 0.5f, 1e-5f);
  EXPECT_NEAR(at(0.0f, engine::Wrap::clampToEdge), 0.0f, 1e-5f);
  EXPECT_NEAR(at(-0.25f, engine::Wrap::mirroredRepeat), 0.0f, 1e-5f);
}

// Lambert under a light straight above: irradiance E leaves as E·(1 - F)·albedo/π, and GGX of roughness 1 adds its peak.
TEST_F(RayTracedSurfaces, ALitMatteSurfaceSendsWhatTheFormulaSays) {
  engine::Scene scene;
  const uint32_t material = addMaterial(scene, {0.8f, 0.4f, 0.2f, 1.0f});
  scene.materials[material].unlit = false;
  scene.materials[material].metallicFactor = 0.0f;
  addQuad(scene, 50.0, 0, 0, 300, 300, material);
  engine::Light sun;
  sun.type = engine::LightType::directional;
  sun.intensity = 3.0f;
  scene.lights.push_back(sun);
  view_.viewpoint.lit = true;
  view_.camera.fovy = 0.01;
  const float pi = std::numbers::pi_v<float>, fresnel = 0.04f, peak = 0.25f / pi;
  const glm::vec3 expected = 3.0f * ((1.0f - fresnel) * glm::vec3(0.8f, 0.4f, 0.2f) / pi + fresnel * peak);
  const glm::vec3 seen = center(scene);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(seen[i], expected[i], 1e-3f);
}

TEST_F(RayTracedSurfaces, SamplesThatAreNotFiniteAreBlackAndCounted) {
  engine::Scene scene;
  const uint32_t material = addMaterial(scene, {1.0f, 1.0f, 1.0f, 1.0f});
  scene.materials[material].baseColorFactor.r = std::numeric_limits<float>::quiet_NaN();
  addQuad(scene, 1.0, 0, 0, 3, 3, material);
  const auto picture = trace(scene, view_, 4);
  EXPECT_EQ(picture.replacedSamples, 4u * 64u);
  EXPECT_EQ(picture.color.pixel(4, 4)[0], 0.0f);
}

}  // namespace
}  // namespace lensgraph::test
