// Materials, textures and images of glTF files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/error.h"
#include "engine/gltf/load_gltf.h"
#include "gltf_builder.h"
#include "raw_png.h"

namespace lensgraph {

namespace {

using engine::ColorEncoding;
using engine::Filter;
using engine::Material;
using engine::Scene;
using engine::Wrap;
using test::GltfBuilder;
using test::Json;
using test::PngColor;
using test::rawPng;
using test::TemporaryFolder;
using test::triangleFile;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::vector<uint8_t> kPixel = rawPng(1, 1, 8, PngColor::rgba, {200, 100, 50, 128});

/// The triangle with UVs in both sets and a material.
GltfBuilder fileWith(const Json& material) {
  GltfBuilder builder = triangleFile();
  Json& primitive = builder.json["meshes"][0]["primitives"][0];
  primitive["material"] = 0;
  for (const char* set : {"TEXCOORD_0", "TEXCOORD_1"})
    primitive["attributes"][set] = builder.addAccessor(std::vector<float>(6, 0.5f), "VEC2");
  builder.json["materials"] = {material};
  return builder;
}

/// Adds a texture of an embedded image; returns its index.
int addTexture(GltfBuilder& builder, const std::vector<uint8_t>& png = kPixel, Json texture = Json::object()) {
  texture["source"] = builder.add("images", {{"bufferView", builder.addView(png)}, {"mimeType", "image/png"}});
  return builder.add("textures", texture);
}

Scene load(GltfBuilder& builder, std::vector<std::string>* warnings = nullptr,
           const engine::GltfOptions& options = {}) {
  const TemporaryFolder folder;
  Scene scene;
  const auto found = engine::appendGltf(scene, builder.write(folder), glm::dmat4(1.0), options);
  if (warnings != nullptr) *warnings = found;
  EXPECT_THAT(engine::findProblems(scene), IsEmpty());
  return scene;
}

Material loadOne(const Json& material) {
  GltfBuilder builder = fileWith(material);
  const Scene scene = load(builder);
  EXPECT_EQ(scene.materials.size(), 1u);
  return scene.materials.at(0);
}

TEST(GltfMaterial, DefaultsAreThoseOfTheSpecification) {
  GltfBuilder none = triangleFile();
  for (const Material& material : {loadOne(Json::object()), load(none).materials.at(0)}) {
    EXPECT_EQ(material.baseColorFactor, glm::vec4(1.0f));
    EXPECT_EQ(material.emissiveFactor, glm::vec3(0.0f));
    EXPECT_EQ(material.emissiveStrength, 1.0f);
    EXPECT_EQ(material.metallicFactor, 1.0f);
    EXPECT_EQ(material.roughnessFactor, 1.0f);
    EXPECT_EQ(material.alphaMode, engine::AlphaMode::opaque);
    EXPECT_EQ(material.alphaCutoff, 0.5f);
    EXPECT_FALSE(material.doubleSided);
    EXPECT_FALSE(material.unlit);
    EXPECT_FALSE(material.baseColorTexture.isUsed());
  }
}

TEST(GltfMaterial, FactorsAndModes) {
  const Material material =
      loadOne({{"name", "paint"},
               {"alphaMode", "MASK"},
               {"alphaCutoff", 0.25},
               {"doubleSided", true},
               {"emissiveFactor", {0.5, 0.25, 1}},
               {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 12}}}}},
               {"pbrMetallicRoughness",
                {{"baseColorFactor", {0.1, 0.2, 0.3, 0.4}}, {"metallicFactor", 0}, {"roughnessFactor", 0.75}}}});
  EXPECT_EQ(material.name, "paint");
  EXPECT_EQ(material.alphaMode, engine::AlphaMode::mask);
  EXPECT_EQ(material.alphaCutoff, 0.25f);
  EXPECT_TRUE(material.doubleSided);
  EXPECT_EQ(material.emissiveFactor, glm::vec3(0.5f, 0.25f, 1.0f));
  EXPECT_EQ(material.emissiveStrength, 12.0f);
  EXPECT_EQ(material.baseColorFactor, glm::vec4(0.1f, 0.2f, 0.3f, 0.4f));
  EXPECT_EQ(material.metallicFactor, 0.0f);
  EXPECT_EQ(material.roughnessFactor, 0.75f);
  EXPECT_EQ(loadOne({{"alphaMode", "BLEND"}}).alphaMode, engine::AlphaMode::blend);
}

TEST(GltfMaterial, UnlitDropsTheEmissivePart) {
  const Material material =
      loadOne({{"emissiveFactor", {1, 1, 1}}, {"extensions", {{"KHR_materials_unlit", Json::object()}}}});
  EXPECT_TRUE(material.unlit);
  EXPECT_EQ(material.emissiveFactor, glm::vec3(0.0f));
}

TEST(GltfMaterial, TexturesSayHowTheirImagesAreEncoded) {
  GltfBuilder builder = fileWith(Json::object());
  const int texture = addTexture(builder);
  builder.json["materials"][0] = {
      {"emissiveFactor", {1, 1, 1}},
      {"emissiveTexture", {{"index", texture}}},
      {"normalTexture", {{"index", texture}, {"scale", 0.5}}},
      {"occlusionTexture", {{"index", texture}, {"strength", 0.25}, {"texCoord", 1}}},
      {"pbrMetallicRoughness",
       {{"baseColorTexture", {{"index", texture}}}, {"metallicRoughnessTexture", {{"index", texture}}}}}};
  const Scene scene = load(builder);
  const Material& material = scene.materials[0];
  const auto imageOf = [&](const engine::TextureUse& use) { return scene.images[scene.textures[use.texture].image]; };
  EXPECT_EQ(imageOf(material.baseColorTexture).encoding, ColorEncoding::srgb);
  EXPECT_EQ(imageOf(material.emissiveTexture).encoding, ColorEncoding::srgb);
  EXPECT_EQ(imageOf(material.metallicRoughnessTexture).encoding, ColorEncoding::linear);
  EXPECT_EQ(imageOf(material.normalTexture).encoding, ColorEncoding::linear);
  EXPECT_EQ(imageOf(material.occlusionTexture).encoding, ColorEncoding::linear);
  EXPECT_EQ(material.normalScale, 0.5f);
  EXPECT_EQ(material.occlusionStrength, 0.25f);
  EXPECT_EQ(material.occlusionTexture.uvSet, 1u);
  EXPECT_EQ(scene.images.size(), 2u);  // one per encoding, however often it is used
  EXPECT_EQ(scene.textures.size(), 2u);
  for (const engine::SceneImage& image : scene.images) EXPECT_THAT(image.rgba, ElementsAre(200, 100, 50, 128));

  const Scene unlitOnly = load(builder, nullptr, {.isLit = false});
  EXPECT_EQ(unlitOnly.images.size(), 1u);
  EXPECT_TRUE(unlitOnly.materials[0].emissiveTexture.isUsed());
  EXPECT_FALSE(unlitOnly.materials[0].normalTexture.isUsed());
}

TEST(GltfMaterial, SamplersAndTheirDefaults) {
  GltfBuilder builder = fileWith(Json::object());
  builder.json["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}, {"minFilter", 9985}},
                              {{"minFilter", 9728}}};
  const int plain = addTexture(builder), first = addTexture(builder, kPixel, {{"sampler", 0}}),
            second = addTexture(builder, kPixel, {{"sampler", 1}});
  Json& primitives = builder.json["meshes"][0]["primitives"];
  builder.json["materials"] = Json::array();
  for (int texture : {plain, first, second}) {
    builder.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", texture}}}}}});
    if (texture != plain) primitives.push_back(primitives[0]);
    primitives.back()["material"] = texture;
  }
  const Scene scene = load(builder);
  ASSERT_EQ(scene.materials.size(), 3u);
  const auto textureOf = [&](size_t material) {
    return scene.textures[scene.materials[material].baseColorTexture.texture];
  };
  EXPECT_EQ(textureOf(0).wrapS, Wrap::repeat);
  EXPECT_EQ(textureOf(0).magFilter, Filter::linear);
  EXPECT_EQ(textureOf(0).mipFilter, Filter::linear);
  EXPECT_EQ(textureOf(1).wrapS, Wrap::clampToEdge);
  EXPECT_EQ(textureOf(1).wrapT, Wrap::mirroredRepeat);
  EXPECT_EQ(textureOf(1).magFilter, Filter::nearest);
  EXPECT_EQ(textureOf(1).minFilter, Filter::linear);
  EXPECT_EQ(textureOf(1).mipFilter, Filter::nearest);
  EXPECT_EQ(textureOf(2).minFilter, Filter::nearest);
  EXPECT_FALSE(textureOf(2).mipFilter.has_value());
}

TEST(GltfMaterial, TextureTransformOverridesTheUvSet) {
  GltfBuilder builder = fileWith(Json::object());
  const Json transform = {
      {"offset", {0.5, 0.25}}, {"rotation", 1.5707963267948966}, {"scale", {2, 3}}, {"texCoord", 1}};
  builder.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {
      {"index", addTexture(builder)}, {"texCoord", 0}, {"extensions", {{"KHR_texture_transform", transform}}}};
  const engine::TextureUse use = load(builder).materials[0].baseColorTexture;
  EXPECT_EQ(use.uvSet, 1u);
  // KHR_texture_transform: T · R · S; u turns towards −v by 90 degrees.
  const glm::vec2 u = engine::transformUv(use, {1, 0}), v = engine::transformUv(use, {0, 1});
  EXPECT_NEAR(u.x, 0.5, 1e-6);
  EXPECT_NEAR(u.y, 0.25 - 2, 1e-6);
  EXPECT_NEAR(v.x, 0.5 + 3, 1e-6);
  EXPECT_NEAR(v.y, 0.25, 1e-6);
}

/// Sets 2, 3 and 4 beside those of fileWith(), every vertex of set n at (n, n).
GltfBuilder fileWithFiveUvSets(const Json& material) {
  GltfBuilder builder = fileWith(material);
  for (int set = 2; set < 5; ++set) {
    builder.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_" + std::to_string(set)] =
        builder.addAccessor(std::vector<float>(6, static_cast<float>(set)), "VEC2");
  }
  return builder;
}

TEST(GltfMaterial, HighUvSetsTakeTheSlotsThatThePrimitiveHas) {
  GltfBuilder builder = fileWithFiveUvSets(Json::object());
  const int texture = addTexture(builder);
  builder.json["materials"][0] = {
      {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", texture}, {"texCoord", 3}}}}},
      {"normalTexture", {{"index", texture}, {"texCoord", 2}}},
      {"occlusionTexture", {{"index", texture}, {"texCoord", 3}}}};
  std::vector<std::string> warnings;
  const Scene scene = load(builder, &warnings);
  EXPECT_THAT(warnings, IsEmpty());
  const Material& material = scene.materials[0];
  const auto uvOf = [&](const engine::TextureUse& use) { return scene.primitives[0].uvs[use.uvSet].at(0); };
  EXPECT_EQ(uvOf(material.baseColorTexture), glm::vec2(3));
  EXPECT_EQ(uvOf(material.normalTexture), glm::vec2(2));
  EXPECT_EQ(uvOf(material.occlusionTexture), glm::vec2(3));
}

TEST(GltfMaterial, AThirdUvSetIsLeftOutWithAWarning) {
  GltfBuilder builder = fileWithFiveUvSets(Json::object());
  const int texture = addTexture(builder);
  builder.json["materials"][0] = {
      {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", texture}, {"texCoord", 4}}}}},
      {"normalTexture", {{"index", texture}, {"texCoord", 2}}},
      {"occlusionTexture", {{"index", texture}}}};
  std::vector<std::string> warnings;
  const Scene scene = load(builder, &warnings);
  EXPECT_TRUE(scene.materials[0].normalTexture.isUsed());
  EXPECT_FALSE(scene.materials[0].occlusionTexture.isUsed());
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("materials[0]: a material uses more than two UV sets")));
}

TEST(GltfMaterial, AnUnusedSecondSetIsNoPlaceForAMissingOne) {
  GltfBuilder builder = fileWith(Json::object());
  builder.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", addTexture(builder)},
                                                                              {"texCoord", 2}};
  std::vector<std::string> warnings;
  load(builder, &warnings);
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("has no TEXCOORD_2")));
}

TEST(GltfMaterial, MissingUvsAreAWarning) {
  GltfBuilder builder = fileWith(Json::object());
  builder.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", addTexture(builder)}};
  builder.json["meshes"][0]["primitives"][0]["attributes"].erase("TEXCOORD_0");
  std::vector<std::string> warnings;
  load(builder, &warnings);
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("has no TEXCOORD_0")));
}

// ---- Transmission

/// Glass of a colour whose alpha does not count, as OPAQUE says.
Json glass(double factor) {
  return {
      {"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, 0.5}}}},
      {"extensions",
       {{"KHR_materials_transmission", {{"transmissionFactor", factor}}}, {"KHR_materials_volume", Json::object()}}}};
}

TEST(GltfTransmission, IsAlphaInLitPictures) {
  GltfBuilder builder = fileWith(glass(0.75));
  builder.json["extensionsRequired"] = {"KHR_materials_transmission", "KHR_materials_volume"};
  std::vector<std::string> warnings;
  const Material material = load(builder, &warnings).materials.at(0);
  EXPECT_EQ(material.alphaMode, engine::AlphaMode::blend);
  EXPECT_EQ(material.baseColorFactor, glm::vec4(1, 1, 1, 0.25f));
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("materials[0]: KHR_materials_transmission is drawn as alpha")));
}

TEST(GltfTransmission, ScalesTheAlphaOfBlendedMaterials) {
  Json material = glass(0.5);
  material["alphaMode"] = "BLEND";
  EXPECT_EQ(loadOne(material).baseColorFactor.a, 0.25f);
}

TEST(GltfTransmission, LeavesALittleOfTheClearestGlass) {
  EXPECT_EQ(loadOne(glass(1)).baseColorFactor.a, 0.08f);
}

TEST(GltfTransmission, OfNothingChangesNothing) {
  const Material material = loadOne(glass(0));
  EXPECT_EQ(material.alphaMode, engine::AlphaMode::opaque);
  EXPECT_EQ(material.baseColorFactor.a, 0.5f);
}

TEST(GltfTransmission, IsIgnoredInUnlitPicturesAndByUnlitMaterials) {
  GltfBuilder builder = fileWith(glass(1));
  std::vector<std::string> warnings;
  EXPECT_EQ(load(builder, &warnings, {.isLit = false}).materials.at(0).alphaMode, engine::AlphaMode::opaque);
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("KHR_materials_transmission is ignored in unlit pictures")));
  Json unlit = glass(1);
  unlit["extensions"]["KHR_materials_unlit"] = Json::object();
  EXPECT_EQ(loadOne(unlit).alphaMode, engine::AlphaMode::opaque);
}

// ---- Images

class TextureExtension : public testing::TestWithParam<const char*> {};

TEST_P(TextureExtension, IsNamedWhenThereIsNoFallbackAndElseIgnored) {
  for (bool hasFallback : {false, true}) {
    GltfBuilder builder = fileWith(Json::object());
    builder.json["extensionsUsed"] = {GetParam()};
    addTexture(builder);
    Json& texture = builder.json["textures"][0];
    texture["extensions"][GetParam()]["source"] = builder.add("images", {{"uri", "missing.ktx2"}});
    if (!hasFallback) texture.erase("source");
    builder.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
    try {
      EXPECT_THAT(load(builder).images.at(0).rgba, ElementsAre(200, 100, 50, 128));
      EXPECT_TRUE(hasFallback);
    } catch (const engine::Error& error) {
      EXPECT_FALSE(hasFallback);
      EXPECT_THAT(error.what(), HasSubstr("textures[0]: has its image in " + std::string(GetParam()) +
                                          " alone, which is not read; export with PNG or JPEG textures"));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, TextureExtension,
                         testing::Values("KHR_texture_basisu", "EXT_texture_webp", "EXT_texture_avif",
                                         "MSFT_texture_dds"));

std::vector<uint8_t> pixelsOf(const std::vector<uint8_t>& png) {
  GltfBuilder builder = fileWith(Json::object());
  builder.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", addTexture(builder, png)}};
  return load(builder).images.at(0).rgba;
}

TEST(GltfImage, EveryPngBecomesRgba8) {
  EXPECT_THAT(pixelsOf(rawPng(1, 1, 8, PngColor::rgb, {1, 2, 3})), ElementsAre(1, 2, 3, 255));
  EXPECT_THAT(pixelsOf(rawPng(1, 1, 8, PngColor::grey, {77})), ElementsAre(77, 77, 77, 255));
  EXPECT_THAT(pixelsOf(rawPng(1, 1, 16, PngColor::rgba, {65535, 32896, 128, 0})), ElementsAre(255, 128, 0, 0));
  EXPECT_THAT(pixelsOf(rawPng(2, 1, 8, PngColor::grey, {1, 2})), ElementsAre(1, 1, 1, 255, 2, 2, 2, 255));
}

TEST(GltfImage, DataUriAndExternalFile) {
  const TemporaryFolder folder;
  test::writeBytes(folder / "my pixel.png", kPixel);
  for (const std::string& uri : {"data:image/png;base64," + test::base64(kPixel), std::string("my%20pixel.png")}) {
    GltfBuilder builder = fileWith(Json::object());
    builder.json["images"] = {{{"uri", uri}}};
    builder.json["textures"] = {{{"source", 0}}};
    builder.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
    Scene scene;
    engine::appendGltf(scene, builder.write(folder));
    EXPECT_THAT(scene.images.at(0).rgba, ElementsAre(200, 100, 50, 128));
  }
}

TEST(GltfImage, WhatNothingDrawsIsNotOpened) {
  GltfBuilder builder = fileWith(Json::object());
  builder.json["images"] = {{{"uri", "missing.png"}}};
  builder.json["textures"] = {{{"source", 0}}};
  builder.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});  // material 1, unused
  EXPECT_THAT(load(builder).images, IsEmpty());
}

std::string errorWithImage(const Json& image, const TemporaryFolder& folder) {
  GltfBuilder builder = fileWith(Json::object());
  builder.json["images"] = {image};
  builder.json["textures"] = {{{"source", 0}}};
  builder.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
  try {
    Scene scene;
    engine::appendGltf(scene, builder.write(folder));
  } catch (const engine::Error& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    return error.what();
  }
  return "no error";
}

TEST(GltfImage, BadImagesAreNamed) {
  const TemporaryFolder folder;
  test::writeBytes(folder / "empty.png", {});
  test::writeBytes(folder / "text.png", std::vector<uint8_t>(100, 'x'));
  const auto fileNamed = [&](const std::string& name) { return errorWithImage({{"uri", name}}, folder); };
  EXPECT_THAT(fileNamed("missing.png"), HasSubstr("images[0].uri: 'missing.png': no such file"));
  EXPECT_THAT(fileNamed("empty.png"), HasSubstr("images[0]: 'empty.png' is empty (0 bytes)"));
  EXPECT_THAT(fileNamed("text.png"), HasSubstr("images[0]: 'text.png' is neither PNG nor JPEG"));
  EXPECT_THAT(fileNamed("http://example.org/a.png"), HasSubstr("is not a local file"));
  EXPECT_THAT(fileNamed("data:image/png,raw"), HasSubstr("images[0]: is neither PNG nor JPEG"));
  EXPECT_THAT(fileNamed("data:image/png;base64"), HasSubstr("data URI has no comma"));
  EXPECT_THAT(fileNamed("data:image/png;base64,????"), HasSubstr("not base64"));
  EXPECT_THAT(errorWithImage(Json::object(), folder), HasSubstr("images[0]: has neither uri nor bufferView"));
}

TEST(GltfImage, TruncatedAtEveryLength) {
  const TemporaryFolder folder;
  const std::vector<uint8_t> png = rawPng(16, 16, 8, PngColor::rgba, std::vector<uint16_t>(1024, 99));
  for (size_t length = 1; length + 1024 < png.size(); length += 3) {
    test::writeBytes(folder / "cut.png", std::span(png).first(length));
    EXPECT_THAT(errorWithImage({{"uri", "cut.png"}}, folder), HasSubstr("images[0]: 'cut.png' is ")) << length;
  }
}

TEST(GltfImage, NoPixels) {
  const TemporaryFolder folder;
  std::vector<uint8_t> png = rawPng(1, 1, 8, PngColor::grey, {0});
  png[19] = 0;  // width 0
  test::writeBytes(folder / "none.png", png);
  EXPECT_THAT(errorWithImage({{"uri", "none.png"}}, folder), HasSubstr("images[0]: 'none.png' is damaged"));
}

}  // namespace

}  // namespace lensgraph
