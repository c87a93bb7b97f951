// Taps as declarations: what is matched, when the copy is added, and that it keeps alive what it looks at.
#include "rendergraph/image_tap.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rendergraph/executor.h"
#include "support/fake_backend.h"

namespace lensgraph {

using namespace rendergraph;
using testing::ElementsAre;
using testing::IsEmpty;

namespace {

const ImageDesc kDesc{.format = VK_FORMAT_R16G16B16A16_SFLOAT, .width = 64, .height = 32, .layers = 2, .mips = 3};
const AccessState kSampled{VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
                           VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};

class Taps : public testing::Test {
 protected:
  Taps() { graph_.observe(&taps_); }
  Image write(const char* pass, Image image, Subresources range = {}) {
    return graph_.addPass(pass, PassKind::compute).write(image, Usage::storage, range);
  }
  /// first and second write one image, third is not needed by anybody.
  void declare() {
    graph_.reset();
    Image image = graph_.createImage("image", kDesc), other = graph_.createImage("other", kDesc);
    image = write("first", image);
    other = write("third", other);
    image = graph_.addPass("second", PassKind::compute).modify(image, Usage::storage);
    graph_.exportImage(image, kSampled);
    graph_.finish();
  }
  std::vector<std::string> executed() {
    executor_.execute(graph_);
    std::vector<std::string> names;
    for (const CapturedPass& pass : executor_.capture().passes) names.push_back(pass.name);
    return names;
  }

  FakeBackend backend_;
  Executor executor_{backend_};
  ImageTaps taps_;
  Graph graph_;
};

TEST_F(Taps, CopiesTheImageAsItIsRightAfterThePass) {
  taps_.add({.pass = "first", .resource = "image"});
  declare();
  EXPECT_THAT(executed(), ElementsAre("first", "tap first/image", "second"));
  const TappedImage& image = taps_.images().at(0);
  EXPECT_EQ(image.format, kDesc.format);
  EXPECT_EQ(image.extent.width, 64u);
  EXPECT_EQ(image.aspect, VkImageAspectFlags{VK_IMAGE_ASPECT_COLOR_BIT});
  EXPECT_EQ(executor_.mapped(image.buffer).size(), 64u * 32 * 8);
  EXPECT_EQ(backend_.count("copy image to buffer"), 1u);
}

TEST_F(Taps, KeepAPassThatWouldBeCulled) {
  declare();
  EXPECT_THAT(executed(), ElementsAre("first", "second"));
  taps_.add({.pass = "third", .resource = "other"});
  declare();
  EXPECT_THAT(executed(), testing::UnorderedElementsAre("first", "third", "tap third/other", "second"));
}

TEST_F(Taps, AnExportAddsTheTapsOfTheLastPass) {
  taps_.add({.pass = "last", .resource = "image"});
  Image image = write("last", graph_.createImage("image", kDesc));
  graph_.exportImage(image, kSampled);
  EXPECT_TRUE(taps_.images().at(0).buffer);
  EXPECT_THAT(executed(), ElementsAre("last", "tap last/image"));
}

TEST_F(Taps, FinishingAddsTheTapsOfTheLastPass) {
  taps_.add({.pass = "last", .resource = "image"});
  write("last", graph_.createImage("image", kDesc));
  graph_.finish();
  graph_.finish();  // A second time adds nothing.
  EXPECT_THAT(executed(), ElementsAre("last", "tap last/image"));
}

TEST_F(Taps, StayOverAReset) {
  taps_.add({.pass = "first", .resource = "image"});
  declare();
  executed();
  const Buffer before = taps_.images().at(0).buffer;
  declare();
  EXPECT_EQ(executed().size(), 3u);
  EXPECT_NE(taps_.images().at(0).buffer, before);
  graph_.reset();
  EXPECT_FALSE(taps_.images().at(0).buffer) << "of a declaration that has not been made yet";
}

TEST_F(Taps, ATapThatMatchesNothingAddsNothing) {
  taps_.add({.pass = "first", .resource = "other"});
  taps_.add({.pass = "fourth", .resource = "image"});
  taps_.add({.pass = "first", .resource = "image", .mip = 3});
  taps_.add({.pass = "first", .resource = "image", .layer = 2});
  declare();
  EXPECT_EQ(executed().size(), 2u);
  ASSERT_EQ(taps_.images().size(), 4u);
  for (const TappedImage& image : taps_.images()) EXPECT_FALSE(image.buffer);
}

TEST_F(Taps, ATapCopiesOneMipAndLayer) {
  taps_.add({.pass = "mip 1", .resource = "image", .mip = 1, .layer = 1});
  Image image = graph_.createImage("image", kDesc);
  image = write("mip 0", image, mip(0));
  image = write("mip 1", image, mip(1));
  graph_.finish();
  EXPECT_THAT(executed(), ElementsAre("mip 1", "tap mip 1/image")) << "mip 0 is seen by nobody";
  EXPECT_EQ(taps_.images().at(0).extent.width, 32u);
  EXPECT_EQ(executor_.mapped(taps_.images().at(0).buffer).size(), 32u * 16 * 8);
}

TEST_F(Taps, ATapOfDepthCopiesTheDepthAspect) {
  taps_.add({.pass = "draw", .resource = "depth"});
  Image depth = graph_.createImage("depth", {.format = VK_FORMAT_D32_SFLOAT_S8_UINT, .width = 8, .height = 4});
  depth = graph_.addPass("draw", PassKind::raster).depth(depth);
  graph_.finish();
  EXPECT_THAT(executed(), ElementsAre("draw", "tap draw/depth"));
  EXPECT_EQ(taps_.images().at(0).aspect, VkImageAspectFlags{VK_IMAGE_ASPECT_DEPTH_BIT});
}

TEST_F(Taps, TwoTapsOfOnePassAreBothCopied) {
  taps_.add({.pass = "first", .resource = "image"});
  taps_.add({.pass = "first", .resource = "image", .mip = 1});
  declare();
  EXPECT_EQ(executed().size(), 4u);
  EXPECT_NE(taps_.images().at(0).buffer, taps_.images().at(1).buffer);
}

TEST_F(Taps, ChoicesAreTheImagesThatPassesWrite) {
  declare();
  Image many = graph_.createImage(
      "many samples", {.format = VK_FORMAT_R8G8B8A8_UNORM, .width = 4, .height = 4, .samples = VK_SAMPLE_COUNT_4_BIT});
  many = graph_.addPass("multisampled", PassKind::raster).color(many);
  Image hosts = graph_.importImage(
      "host", kDesc,
      {.image = FakeBackend::as<VkImage>(7), .usage = VK_IMAGE_USAGE_STORAGE_BIT, .before = {}, .after = kSampled});
  hosts = write("to host", hosts);
  std::vector<std::string> names;
  for (const TapChoice& choice : tappableImages(graph_)) names.push_back(choice.pass + "/" + choice.resource);
  EXPECT_THAT(names, ElementsAre("first/image", "third/other", "second/image"))
      << "neither several samples nor what the host does not let be copied";
}

}  // namespace

}  // namespace lensgraph
