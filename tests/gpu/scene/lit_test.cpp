// Shaded pictures against radiometry: what a surface under known light must send back.
//
// The references are written here from glTF 2.0 appendix B and KHR_lights_punctual, without the project's
// shaders. White and black base colours in two pictures separate the diffuse part of a dielectric from its
// specular part.
#include <gmock/gmock.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtx/quaternion.hpp>
#include <numbers>

#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/test_scenes.h"

namespace lensgraph {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kSide = 33;  // odd: the middle pixel's centre is on the axis

engine::Light light(engine::LightType type, float intensity, const glm::dvec3& position = {},
                    const glm::dvec3& direction = {0.0, 0.0, -1.0}) {
  engine::Light made;
  made.type = type;
  made.intensity = intensity;
  made.worldFromLight = glm::translate(glm::dmat4(1.0), position) *
                        glm::toMat4(glm::rotation(glm::dvec3(0.0, 0.0, -1.0), glm::normalize(direction)));
  return made;
}

/// A lit material, rough and not metallic.
engine::Material matte(const glm::vec3& color) {
  engine::Material material;
  material.baseColorFactor = glm::vec4(color, 1.0f);
  material.metallicFactor = 0.0f;
  material.roughnessFactor = 1.0f;
  return material;
}

/// A wall at view depth 2 m that fills the picture.
engine::Scene wall(const engine::Material& material) {
  engine::Scene scene;
  scene.materials.push_back(material);
  support::addFacingQuad(scene, 2.0, 0.0, 0.0, 3.0, 3.0, 0);
  return scene;
}

/// A unit sphere at view depth 4 m, smooth normals.
engine::Scene sphere(const engine::Material& material) {
  engine::Scene scene;
  scene.materials.push_back(material);
  engine::Primitive ball;
  constexpr uint32_t kRings = 48, kSlices = 96;
  for (uint32_t ring = 0; ring <= kRings; ++ring) {
    for (uint32_t slice = 0; slice <= kSlices; ++slice) {
      const double theta = kPi * ring / kRings, phi = 2.0 * kPi * slice / kSlices;
      const glm::vec3 n(std::sin(theta) * std::cos(phi), std::cos(theta), -std::sin(theta) * std::sin(phi));
      ball.normals.push_back(n);
      ball.positions.push_back(n + glm::vec3(0.0f, 0.0f, -4.0f));
      ball.bounds.add(ball.positions.back());
      if (ring == kRings || slice == kSlices) continue;
      const uint32_t a = ring * (kSlices + 1) + slice, b = a + kSlices + 1;
      for (const uint32_t index : {a, b, a + 1, a + 1, b, b + 1}) ball.indices.push_back(index);
    }
  }
  ball.material = 0;
  scene.primitives.push_back(ball);
  scene.instances.push_back({.primitive = 0, .worldFromObject = glm::dmat4(1.0), .name = "sphere"});
  return scene;
}

// ---- glTF's metallic-roughness model with GGX, in double

/// Specular reflectance per cosine, Fresnel excluded: D·V.
double specularLobe(double nDotL, double nDotV, double nDotH, double roughness) {
  const double a2 = std::pow(roughness, 4.0);
  const double d = a2 / (kPi * std::pow(nDotH * nDotH * (a2 - 1.0) + 1.0, 2.0));
  return d * 0.5 /
         (nDotL * std::sqrt(nDotV * nDotV * (1.0 - a2) + a2) + nDotV * std::sqrt(nDotL * nDotL * (1.0 - a2) + a2));
}

double fresnel(double f0, double vDotH) {
  return f0 + (1.0 - f0) * std::pow(1.0 - vDotH, 5.0);
}

/// Share of a constant environment that the specular lobe reflects (single scattering), by quadrature over
/// half vectors drawn from D.
double directionalAlbedo(double f0, double nDotV, double roughness) {
  const glm::dvec3 v(std::sqrt(1.0 - nDotV * nDotV), 0.0, nDotV);
  const double a2 = std::pow(roughness, 4.0);
  double sum = 0.0;
  constexpr int kSteps = 64;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps; ++j) {
      const double u = (i + 0.5) / kSteps, phi = 2.0 * kPi * (j + 0.5) / kSteps;
      const double cosine = std::sqrt((1.0 - u) / (1.0 + (a2 - 1.0) * u)), sine = std::sqrt(1.0 - cosine * cosine);
      const glm::dvec3 h(sine * std::cos(phi), sine * std::sin(phi), cosine);
      const double vDotH = glm::dot(v, h);
      const double nDotL = (2.0 * vDotH * h - v).z;
      if (nDotL <= 0.0 || vDotH <= 0.0) continue;
      // The density of l is D·nDotH / (4 vDotH).
      const double lobeOverD =
          specularLobe(nDotL, nDotV, cosine, roughness) * kPi * std::pow(cosine * cosine * (a2 - 1.0) + 1.0, 2.0) / a2;
      sum += fresnel(f0, vDotH) * lobeOverD * nDotL * 4.0 * vDotH / cosine;
    }
  }
  return sum / (kSteps * kSteps);
}

// ---- Tests

class Lit : public support::GpuTest {
 protected:
  engine::FloatImage picture(const engine::Scene& scene, const std::optional<engine::Environment>& environment = {}) {
    EXPECT_THAT(engine::findProblems(scene), testing::IsEmpty());
    host::Renderer renderer(support::device(), scene, environment);
    auto shot = support::smallShot(kSide, kSide);
    shot.shading = host::Shading::lit;
    return support::render(renderer, shot, "pinhole").color;
  }
  double middle(const engine::Scene& scene, const std::optional<engine::Environment>& environment = {}) {
    return static_cast<double>(picture(scene, environment).pixel(kSide / 2, kSide / 2)[0]);
  }
  /// Diffuse radiance of a white wall: its picture less that of a black one.
  double diffuse(const std::vector<engine::Light>& lights) {
    auto white = wall(matte(glm::vec3(1.0f))), black = wall(matte(glm::vec3(0.0f)));
    white.lights = black.lights = lights;
    return middle(white) - middle(black);
  }
};

const engine::Environment& whiteFurnace() {
  static const auto environment = engine::prepareEnvironment(engine::FloatImage(64, 32, 3, 1.0f));
  return environment;
}

/// nDotV and value of the pixels of a sphere in the picture, not too near its silhouette.
template <class Visit>
void eachOfSphere(const engine::FloatImage& image, Visit&& visit) {
  const double s = 0.5 * kSide / std::tan(20.0 * kPi / 180.0);
  for (uint32_t y = 0; y < image.height; ++y) {
    for (uint32_t x = 0; x < image.width; ++x) {
      const glm::dvec3 ray =
          glm::normalize(glm::dvec3((x + 0.5 - 0.5 * kSide) / s, -(y + 0.5 - 0.5 * kSide) / s, -1.0));
      const double along = -4.0 * ray.z;  // to the point of the ray nearest to the centre
      const double missed = 16.0 - along * along;
      if (missed > 0.95) continue;
      const glm::dvec3 point = ray * (along - std::sqrt(1.0 - missed));
      visit(-glm::dot(point + glm::dvec3(0.0, 0.0, 4.0), ray), static_cast<double>(image.pixel(x, y)[0]));
    }
  }
}

// A white dielectric under white light everywhere sends back all of it, at any angle and roughness: what its
// surface reflects does not reach the white ground below. Energy must be neither made nor lost.
TEST_F(Lit, AWhiteDielectricVanishesInAWhiteFurnace) {
  for (const float roughness : {0.1f, 0.5f, 1.0f}) {
    auto material = matte(glm::vec3(1.0f));
    material.roughnessFactor = roughness;
    int pixels = 0;
    double least = 1e9, most = 0.0;
    eachOfSphere(picture(sphere(material), whiteFurnace()), [&](double, double value) {
      least = std::min(least, value);
      most = std::max(most, value);
      ++pixels;
    });
    std::printf("white dielectric, roughness %.1f: %.4f to %.4f of 1\n", static_cast<double>(roughness), least, most);
    EXPECT_GT(pixels, 100);
    EXPECT_GT(least, 0.99);
    EXPECT_LT(most, 1.01);
  }
}

// A white metal reflects what single scattering leaves: all when smooth, 1 - ln 2 at roughness 1 and facing.
// The shader's fit is within 0.045 of the integral; 0.06 allows for the 64×64 quadrature here.
TEST_F(Lit, AWhiteMetalReflectsItsDirectionalAlbedoInAWhiteFurnace) {
  for (const float roughness : {0.1f, 0.3f, 0.6f, 1.0f}) {
    engine::Material material;
    material.roughnessFactor = roughness;
    double worst = 0.0, facing = 0.0;
    eachOfSphere(picture(sphere(material), whiteFurnace()), [&](double nDotV, double value) {
      EXPECT_LT(value, 1.01);
      const double expected = directionalAlbedo(1.0, nDotV, static_cast<double>(roughness));
      worst = std::max(worst, std::abs(value - expected));
      if (nDotV > 0.999) facing = value;
    });
    std::printf("white metal, roughness %.1f: facing %.4f, largest error %.4f of 1\n", static_cast<double>(roughness),
                facing, worst);
    EXPECT_LT(worst, 0.06) << roughness;
    if (roughness < 0.2f) {
      EXPECT_GT(facing, 0.98);
    }
    if (roughness == 1.0f) {
      EXPECT_NEAR(facing, 1.0 - std::log(2.0), 0.06);
    }
  }
}

TEST_F(Lit, ADirectionalLightOnAMatteWallIsLambert) {
  for (const double degrees : {0.0, 30.0, 60.0, 85.0}) {
    const double angle = degrees * kPi / 180.0;
    const auto sun = light(engine::LightType::directional, 1.0f, {}, {std::sin(angle), 0.0, -std::cos(angle)});
    // Fresnel's share stays on the surface: half vector between the axis and the light.
    const double below = 1.0 - fresnel(0.04, std::cos(0.5 * angle));
    const double expected = below * std::cos(angle) / kPi;
    EXPECT_NEAR(diffuse({sun}), expected, 1e-4 * expected) << degrees;
    // And the specular part alone, on a black wall.
    auto black = wall(matte(glm::vec3(0.0f)));
    black.materials[0].roughnessFactor = 0.5f;
    black.lights = {sun};
    const double gloss = fresnel(0.04, std::cos(0.5 * angle)) * std::cos(angle) *
                         specularLobe(std::cos(angle), 1.0, std::cos(0.5 * angle), 0.5);
    EXPECT_NEAR(middle(black), gloss, 1e-3 * gloss) << degrees;
  }
  const auto behind = light(engine::LightType::directional, 1.0f, {}, {0.0, 0.0, 1.0});
  EXPECT_EQ(diffuse({behind}), 0.0);
}

TEST_F(Lit, LightsAddUpAndScaleWithIntensityAndColour) {
  const auto one = light(engine::LightType::directional, 1.0f);
  auto tripled = light(engine::LightType::directional, 1.5f);
  tripled.color = glm::vec3(2.0f, 0.0f, 0.0f);
  EXPECT_NEAR(diffuse({one, one}), 2.0 * diffuse({one}), 1e-6);
  EXPECT_NEAR(diffuse({tripled}), 3.0 * diffuse({one}), 1e-6);
}

TEST_F(Lit, APointLightFallsOffWithTheSquareOfItsDistance) {
  const auto at = [&](double distance) {
    return diffuse({light(engine::LightType::point, 1.0f, {0.0, 0.0, -2.0 + distance})});
  };
  for (const double distance : {0.25, 0.5, 1.0, 4.0}) {  // before and behind the camera
    const double expected = 0.96 / kPi / (distance * distance);
    EXPECT_NEAR(at(distance), expected, 1e-3 * expected) << distance;
  }
  auto ranged = light(engine::LightType::point, 1.0f, {0.0, 0.0, -1.0});
  ranged.range = 1.25f;  // KHR_lights_punctual: (1 - (d/range)⁴) / d²
  EXPECT_NEAR(diffuse({ranged}), (1.0 - std::pow(1.0 / 1.25, 4.0)) * 0.96 / kPi, 1e-4);
  ranged.range = 0.99f;
  EXPECT_EQ(diffuse({ranged}), 0.0);
}

TEST_F(Lit, ASpotLightHasItsConeEdges) {
  const auto tilted = [&](double degrees) {
    const double angle = degrees * kPi / 180.0;
    auto spot = light(engine::LightType::spot, 1.0f, {0.0, 0.0, -1.0}, {std::sin(angle), 0.0, -std::cos(angle)});
    spot.innerConeAngle = static_cast<float>(20.0 * kPi / 180.0);
    spot.outerConeAngle = static_cast<float>(40.0 * kPi / 180.0);
    return diffuse({spot});
  };
  const double full = 0.96 / kPi;
  for (const double degrees : {0.0, 10.0, 19.5}) EXPECT_NEAR(tilted(degrees), full, 1e-4) << degrees;
  for (const double degrees : {40.5, 60.0, 120.0, 180.0}) EXPECT_EQ(tilted(degrees), 0.0) << degrees;
  const auto cosine = [](double degrees) { return std::cos(degrees * kPi / 180.0); };
  const double falloff = (cosine(30.0) - cosine(40.0)) / (cosine(20.0) - cosine(40.0));
  EXPECT_NEAR(tilted(30.0), full * falloff * falloff, 1e-4);
}

TEST_F(Lit, EmissionAddsAndUnlitMaterialsIgnoreLights) {
  auto material = matte(glm::vec3(0.5f));
  auto scene = wall(material);
  scene.lights = {light(engine::LightType::directional, 2.0f)};
  const double lit = middle(scene);
  scene.materials[0].emissiveFactor = glm::vec3(0.25f);
  scene.materials[0].emissiveStrength = 8.0f;
  EXPECT_NEAR(middle(scene), lit + 2.0, 1e-5);
  scene.materials[0].unlit = true;
  EXPECT_EQ(middle(scene), 0.5);
  EXPECT_EQ(middle(wall(matte(glm::vec3(0.5f)))), 0.0) << "no light, no picture";
}

TEST_F(Lit, BothFacesOfASurfaceAreLit) {
  const auto sun = light(engine::LightType::directional, 1.0f);
  auto front = wall(matte(glm::vec3(1.0f)));
  front.lights = {sun};
  auto back = front;
  back.materials[0].doubleSided = true;
  for (auto& normal : back.primitives[0].normals) normal = -normal;
  std::swap(back.primitives[0].indices[1], back.primitives[0].indices[2]);
  std::swap(back.primitives[0].indices[4], back.primitives[0].indices[5]);
  EXPECT_EQ(middle(back), middle(front));
  auto mirrored = front;  // a negative determinant turns winding and normals round
  mirrored.instances[0].worldFromObject = glm::scale(glm::dmat4(1.0), glm::dvec3(-1.0, 1.0, 1.0));
  EXPECT_EQ(middle(mirrored), middle(front));
}

/// A wall with UVs as in a texture seen upright (u right, v down), and a normal map of one texel.
engine::Scene bumpyWall(const std::array<uint8_t, 3>& texel) {
  auto scene = wall(matte(glm::vec3(1.0f)));
  scene.primitives[0].uvs[0] = {{0.0f, 1.0f}, {1.0f, 1.0f}, {1.0f, 0.0f}, {0.0f, 0.0f}};
  scene.images.push_back({.name = "normal",
                          .width = 1,
                          .height = 1,
                          .rgba = {texel[0], texel[1], texel[2], 255},
                          .encoding = engine::ColorEncoding::linear});
  scene.textures.push_back({.image = 0});
  scene.materials[0].normalTexture.texture = 0;
  return scene;
}

TEST_F(Lit, AFlatNormalMapChangesNothing) {
  const std::vector<engine::Light> lights = {
      light(engine::LightType::directional, 1.0f, {}, glm::dvec3(0.6, -0.5, -1.0))};
  auto plain = wall(matte(glm::vec3(1.0f)));
  auto flat = bumpyWall({128, 128, 255});
  plain.lights = flat.lights = lights;
  // 128/255 is 0.2° off the axis: eight bits hold no exact zero.
  EXPECT_NEAR(middle(flat) / middle(plain), 1.0, 0.006);
  flat.materials[0].normalScale = 0.0f;
  EXPECT_EQ(middle(flat), middle(plain));
}

// Red leans the normal to where u grows, green to where v shrinks (glTF: +Y up), on either face of the wall.
TEST_F(Lit, ANormalMapLeansTheWayItsColoursSay) {
  struct Lean {
    std::array<uint8_t, 3> texel;
    glm::dvec3 towards;
  };
  const double half = std::sqrt(0.5);
  const Lean leans[] = {{{218, 128, 218}, {half, 0.0, half}},
                        {{37, 128, 218}, {-half, 0.0, half}},
                        {{128, 218, 218}, {0.0, half, half}},
                        {{128, 37, 218}, {0.0, -half, half}}};
  for (const auto& lean : leans) {
    auto scene = bumpyWall(lean.texel);
    scene.lights = {light(engine::LightType::directional, 1.0f, {}, -lean.towards)};
    auto black = scene;
    black.materials[0].baseColorFactor = {0.0f, 0.0f, 0.0f, 1.0f};
    // The light comes from where the normal points: all of it counts, less Fresnel at half of 45°.
    const double expected = (1.0 - fresnel(0.04, std::cos(kPi / 8.0))) / kPi;
    EXPECT_NEAR(middle(scene) - middle(black), expected, 0.01 * expected)
        << int(lean.texel[0]) << ' ' << int(lean.texel[1]);
  }
}

}  // namespace

}  // namespace lensgraph
