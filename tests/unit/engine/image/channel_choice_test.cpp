// Which channels of an EXR are read as colour and as depth, by their names.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/image/image_io.h"
#include "image/image_test.h"
#include "raw_exr.h"
#include "raw_png.h"
#include "tests/support/temporary_folder.h"

namespace lensgraph {

namespace {

using engine::ChannelChoice;
using engine::PictureRead;
using test::errorOf;
using test::ExrPartData;
using test::ExrWriter;
using test::rawExr;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using Channels = std::vector<std::pair<std::string, float>>;
using Bytes = std::vector<uint8_t>;

PictureRead color(const Bytes& bytes, const std::string& layer = {}) {
  return engine::readImage(std::as_bytes(std::span(bytes)), "a.exr", {.name = layer, .option = "--color-layer"});
}
PictureRead depth(const Bytes& bytes, const std::string& channel = {}) {
  return engine::readDepth(std::as_bytes(std::span(bytes)), "a.exr", {.name = channel, .option = "--depth-channel"});
}
float depthIn(const Channels& channels) {
  return depth(rawExr(channels)).image.samples.at(0);
}
std::string depthError(const Channels& channels) {
  return errorOf([&] { depth(rawExr(channels)); });
}

ExrPartData part(const std::string& name, const Channels& channels) {
  ExrPartData made{.name = name, .channels = {}, .attributes = {}};
  for (const auto& [channel, value] : channels) made.channels.push_back({channel, {value}});
  return made;
}

// ---- Depth

TEST(DepthChannel, IsFoundByItsName) {
  for (const std::string name : {"Z", "z", "depth", "Depth", "DEPTH", "Depth.Z", "Depth.V", "depth.z",
                                 "ViewLayer.Depth.Z", "Scene.View Layer.Depth.V", "beauty.Z", "depth.R", "zdepth"}) {
    SCOPED_TRACE(name);
    EXPECT_EQ(depthIn({{"R", 1}, {"G", 2}, {"B", 3}, {"A", 4}, {name, 5}}), 5.0f);
    EXPECT_EQ(depthIn({{name, 5}}), 5.0f);
  }
}

TEST(DepthChannel, OfALayerCalledDepthComesBeforeZOfAnother) {
  EXPECT_EQ(depthIn({{"ViewLayer.Combined.R", 1}, {"ViewLayer.Denoising Depth.Z", 2}, {"ViewLayer.Depth.Z", 5}}), 5.0f);
  EXPECT_EQ(depthIn({{"ViewLayer.Combined.R", 1}, {"ViewLayer.Denoising Depth.Z", 5}}), 5.0f);
}

TEST(DepthChannel, IsNeverPartOfAVector) {
  const Channels rgb = {{"R", 1}, {"G", 2}, {"B", 3}};
  for (const std::string layer : {"Normal", "ViewLayer.Normal", "normals", "N", "Position", "P", "Pworld", "UV",
                                  "ViewLayer.Vector", "motion", "velocity", "unheardOf"}) {
    SCOPED_TRACE(layer);
    Channels channels = rgb;
    for (const std::string leaf : {".X", ".Y", ".Z"}) channels.push_back({layer + leaf, 7});
    EXPECT_THAT(depthError(channels),
                AllOf(HasSubstr("has no depth channel"), HasSubstr(layer + ".Z"), HasSubstr("--depth-channel NAME")));
    channels.push_back({"ViewLayer.Depth.Z", 5});
    EXPECT_EQ(depthIn(channels), 5.0f);
  }
  EXPECT_THAT(depthError({{"UV.U", 1}, {"UV.V", 2}, {"UV.A", 3}}), HasSubstr("has no depth channel"));
  EXPECT_THAT(depthError({{"Mist.Z", 1}}), HasSubstr("has no depth channel"));
}

TEST(DepthChannel, IsNeverColour) {
  EXPECT_THAT(depthError({{"R", 1}, {"G", 2}, {"B", 3}}), AllOf(HasSubstr("it has"), HasSubstr("--depth-channel")));
  EXPECT_THAT(depthError({{"X", 1}, {"Y", 2}, {"Z", 3}}), HasSubstr("has no depth channel"));
  for (const std::string name : {"R", "Y", "A", "X", "luminance"}) {
    EXPECT_THAT(depthError({{name, 1}}), AllOf(HasSubstr(name), HasSubstr("--depth-channel NAME")));
    EXPECT_EQ(depth(rawExr({{name, 1}}), name).image.samples.at(0), 1.0f);
  }
}

TEST(DepthChannel, IsTheOnlyOneOfAFileWhateverElseItIsCalled) {
  for (const std::string name : {"V", "distance", "channel1", "Kinect.range"}) EXPECT_EQ(depthIn({{name, 5}}), 5.0f);
}

TEST(DepthChannel, SeveralAreListedAndOneIsChosen) {
  const Bytes bytes = rawExr({{"A.Depth.Z", 1}, {"B.Depth.Z", 2}, {"Depth.Z", 3}});
  EXPECT_THAT(errorOf([&] { depth(bytes); }), AllOf(HasSubstr("several depth channels: A.Depth.Z, B.Depth.Z, Depth.Z"),
                                                    HasSubstr("choose one with --depth-channel NAME")));
  EXPECT_EQ(depth(bytes, "B.Depth.Z").image.samples.at(0), 2.0f);
  EXPECT_EQ(depth(bytes, "b.depth.z").image.samples.at(0), 2.0f) << "in either case";
  EXPECT_THAT(errorOf([&] { depth(bytes, "C.Depth.Z"); }), AllOf(HasSubstr("'C.Depth.Z'"), HasSubstr("B.Depth.Z")));
}

TEST(DepthChannel, AHundredAreListedShortened) {
  Channels channels;
  for (int i = 0; i < 100; ++i) channels.push_back({"View layer number " + std::to_string(i) + ".Depth.Z", 1.0f});
  const std::string error = depthError(channels);
  EXPECT_LT(error.size(), 450u);
  EXPECT_THAT(error, HasSubstr("100 in all"));
}

TEST(DepthChannel, MayBeInAnyPart) {
  const Channels rgba = {{"R", 1}, {"G", 2}, {"B", 3}, {"A", 4}};
  for (const bool isFirst : {false, true}) {
    std::vector<ExrPartData> parts = {part("rgba", rgba), part("depth", {{"Z", 5}})};
    if (isFirst) std::swap(parts[0], parts[1]);
    const auto bytes = ExrWriter::file(parts);
    const PictureRead read = depth(bytes);
    EXPECT_EQ(read.image.samples.at(0), 5.0f);
    EXPECT_EQ(read.from.part, "depth");
    EXPECT_THAT(read.from.channels, ElementsAre("Z"));
    EXPECT_THAT(color(bytes).image.samples, testing::Contains(3.0f));
    EXPECT_EQ(color(bytes).from.part, "rgba");
  }
  // A part's name is the layer of channels that name none.
  EXPECT_EQ(depth(ExrWriter::file({part("depth", {{"R", 5}}), part("rgba", rgba)})).image.samples.at(0), 5.0f);
  EXPECT_THAT(errorOf([&] {
                depth(ExrWriter::file({part("normal", {{"Z", 5}}), part("rgba", rgba)}));
              }),
              HasSubstr("normal.Z"));
  const auto eyes = ExrWriter::file({part("left", {{"Z", 5}}), part("right", {{"Z", 6}})});
  EXPECT_THAT(errorOf([&] { depth(eyes); }), HasSubstr("left.Z, right.Z"));
  EXPECT_EQ(depth(eyes, "right.Z").image.samples.at(0), 6.0f);
}

TEST(DepthChannel, OfIntegersKeepsItsNumbers) {
  ExrPartData integers{.name = "", .channels = {{.name = "Z", .values = {70000}, .isInteger = true}}, .attributes = {}};
  EXPECT_EQ(depth(ExrWriter::file({integers})).image.samples.at(0), 70000.0f);
}

TEST(DepthChannel, IsInfiniteOutsideTheDataWindow) {
  ExrPartData cropped = part("", {{"Z", 5}});
  cropped.dataX = 1;
  cropped.displayWidth = 4;
  cropped.displayHeight = 1;
  const float infinity = std::numeric_limits<float>::infinity();
  EXPECT_THAT(depth(ExrWriter::file({cropped})).image.samples, ElementsAre(infinity, 5, 5, infinity));
}

TEST(DepthChannel, OfOneLayerInSeveralPartsIsNamedByItsPart) {
  const auto eyes = ExrWriter::file({part("left", {{"Depth.Z", 5}}), part("right", {{"Depth.Z", 6}})});
  EXPECT_THAT(errorOf([&] { depth(eyes); }), HasSubstr("left.Depth.Z, right.Depth.Z"));
  EXPECT_EQ(depth(eyes, "right.Depth.Z").image.samples.at(0), 6.0f);
  EXPECT_EQ(depth(eyes, "right.Depth.Z").from.part, "right");
}

// ---- Depth as integers

PictureRead depthOfPng(const Bytes& bytes, const std::string& channel = {}) {
  return engine::readDepth(std::as_bytes(std::span(bytes)), "a.png", {.name = channel, .option = "--depth-channel"});
}

TEST(DepthOfPng, IsTheIntegersThemselves) {
  const PictureRead fine = depthOfPng(test::rawPng(3, 1, 16, test::PngColor::grey, {0, 1500, 65535}));
  EXPECT_THAT(fine.image.samples, ElementsAre(0, 1500, 65535));
  EXPECT_EQ(fine.largestInteger, 65535u);
  const PictureRead coarse = depthOfPng(test::rawPng(3, 1, 8, test::PngColor::grey, {0, 15, 255}));
  EXPECT_THAT(coarse.image.samples, ElementsAre(0, 15, 255));
  EXPECT_EQ(coarse.largestInteger, 255u);
  EXPECT_THAT(depthOfPng(test::rawPng(1, 1, 16, test::PngColor::greyAlpha, {1500, 7})).image.samples,
              ElementsAre(1500));
}

TEST(DepthOfPng, InThreeEqualChannelsIsGrey) {
  EXPECT_THAT(depthOfPng(test::rawPng(2, 1, 8, test::PngColor::rgb, {9, 9, 9, 8, 8, 8})).image.samples,
              ElementsAre(9, 8));
  const auto colored = test::rawPng(2, 1, 8, test::PngColor::rgb, {9, 9, 9, 8, 7, 8});
  EXPECT_THAT(errorOf([&] { depthOfPng(colored); }), HasSubstr("--depth-channel"));
  EXPECT_THAT(depthOfPng(colored, "G").image.samples, ElementsAre(9, 7));
}

// ---- Colour

TEST(ColorLayer, TheUnnamedOneIsTaken) {
  const PictureRead read =
      color(rawExr({{"R", 1}, {"G", 2}, {"B", 3}, {"DiffCol.R", 4}, {"DiffCol.G", 5}, {"DiffCol.B", 6}}));
  ASSERT_EQ(read.image.channels, 3u);
  EXPECT_EQ(read.image.samples.at(2), 3.0f);
  EXPECT_EQ(read.from.layer, "");
  EXPECT_THAT(read.from.channels, ElementsAre("R", "G", "B"));
}

TEST(ColorLayer, TheCombinedOneIsTaken) {
  for (const std::string layer : {"ViewLayer.Combined", "beauty", "rgba", "Main.RGBA"}) {
    const PictureRead read = color(rawExr({{layer + ".R", 1},
                                           {layer + ".G", 2},
                                           {layer + ".B", 3},
                                           {layer + ".A", .5f},
                                           {"ViewLayer.DiffCol.R", 4},
                                           {"ViewLayer.DiffCol.G", 5},
                                           {"ViewLayer.DiffCol.B", 6}}));
    ASSERT_EQ(read.image.channels, 4u) << layer;
    EXPECT_EQ(read.image.samples.at(3), 0.5f);
    EXPECT_EQ(read.from.layer, layer);
  }
}

TEST(ColorLayer, SeveralAreListedAndOneIsChosen) {
  const Bytes bytes = rawExr({{"a.R", 1}, {"a.G", 2}, {"a.B", 3}, {"b.r", 4}, {"b.g", 5}, {"b.b", 6}, {"n.X", 7}});
  EXPECT_THAT(errorOf([&] { color(bytes); }),
              AllOf(HasSubstr("several colour layers: a, b"), HasSubstr("choose one with --color-layer NAME")));
  EXPECT_EQ(color(bytes, "B").image.samples.at(0), 4.0f);
  EXPECT_THAT(errorOf([&] { color(bytes, "c"); }), AllOf(HasSubstr("'c'"), HasSubstr("a, b")));
}

TEST(ColorLayer, DataInChannelsCalledLikeColoursAreNone) {
  const Bytes bytes = rawExr({{"main.R", 1},
                              {"main.G", 2},
                              {"main.B", 3},
                              {"CryptoObject00.r", 4},
                              {"CryptoObject00.g", 5},
                              {"CryptoObject00.b", 6},
                              {"Normal.R", 7},
                              {"Normal.G", 8},
                              {"Normal.B", 9}});
  EXPECT_EQ(color(bytes).from.layer, "main");
  EXPECT_EQ(color(bytes, "Normal").image.samples.at(0), 7.0f) << "when asked for";
}

TEST(ColorLayer, LettersMayBeInEitherCase) {
  EXPECT_EQ(color(rawExr({{"r", 1}, {"g", 2}, {"b", 3}, {"a", 4}})).image.channels, 4u);
  EXPECT_EQ(color(rawExr({{"red", 1}, {"green", 2}, {"blue", 3}})).image.samples.at(1), 2.0f);
}

TEST(ColorLayer, LuminanceAloneIsGrey) {
  EXPECT_EQ(color(rawExr({{"Y", 1}})).image.channels, 1u);
  EXPECT_EQ(color(rawExr({{"Y", 1}, {"A", 1}})).image.channels, 4u);
  EXPECT_THAT(errorOf([] {
                color(rawExr({{"X", 1}, {"Y", 2}, {"Z", 3}}));
              }),
              HasSubstr("X, Y, Z are not read as colour"));
  EXPECT_THAT(errorOf([] { color(rawExr({{"BY", 1}, {"RY", 2}, {"Y", 3}})); }), HasSubstr("luminance and chroma"));
  ExrPartData subsampled = part("", {{"Y", 3}});
  subsampled.channels.push_back({.name = "RY", .values = {1}, .sampling = 2});
  subsampled.channels.push_back({.name = "BY", .values = {1}, .sampling = 2});
  EXPECT_THAT(errorOf([&] { color(ExrWriter::file({subsampled})); }), HasSubstr("luminance and chroma"));
}

TEST(ColorLayer, DepthAloneIsNoColour) {
  EXPECT_THAT(errorOf([] {
                color(rawExr({{"Depth.Z", 1}, {"Normal.X", 2}}));
              }),
              HasSubstr("no colour channels R, G, B"));
}

TEST(ColorLayer, DeepPartsAreLeftOutAndSaidWhenNothingElseIsThere) {
  ExrPartData deep = part("deep", {{"R", 1}, {"G", 2}, {"B", 3}});
  deep.type = "deepscanline";
  deep.attributes = {{"version", "int", ExrWriter::word(1)}};
  EXPECT_THAT(errorOf([&] { color(ExrWriter::file({deep, deep}, 0x800)); }), HasSubstr("deep data, which is not read"));
}

TEST(ColorLayer, ChannelsKeepTheirPlacesWhateverTheirOrderInTheFile) {
  ExrPartData cropped{.name = "", .channels = {}, .width = 2, .height = 1, .attributes = {}};
  for (const auto& [name, value] :
       Channels{{"A", 4}, {"AA", 9}, {"B", 3}, {"Blue2", 9}, {"G", 2}, {"GG", 9}, {"R", 1}}) {
    cropped.channels.push_back({name, {value, value + 10}});
  }
  cropped.dataX = -1;
  cropped.displayWidth = 2;
  cropped.displayHeight = 2;
  EXPECT_THAT(color(ExrWriter::file({cropped})).image.samples,
              ElementsAre(11, 12, 13, 14, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0));
}

// ---- Pictures that failed

TEST(CasePictures, DepthIsTheRightChannel) {
  const auto blender = test::casePicture("exr_blender_depth_normal.exr");
  if (!std::filesystem::exists(blender)) GTEST_SKIP() << "no " << blender;
  const auto reference = engine::readDepth(test::casePicture("exr_rgbaz.exr"), {});
  EXPECT_THAT(engine::readDepth(blender, {}).from.channels, ElementsAre("ViewLayer.Depth.Z"));
  EXPECT_EQ(engine::readDepth(blender, {}).image.samples, reference.image.samples);
  EXPECT_THAT(engine::readDepth(test::casePicture("10_rgb_depthZ_normalXYZ.exr"), {}).from.channels,
              ElementsAre("depth.Z"));
  EXPECT_EQ(engine::readDepth(test::casePicture("11_multipart_rgba_depth.exr"), {}).from.part, "depth");
  EXPECT_THAT(errorOf([] { engine::readDepth(test::casePicture("13_color_given_as_depth.exr")); }),
              HasSubstr("has no depth channel"));
}

}  // namespace

}  // namespace lensgraph
