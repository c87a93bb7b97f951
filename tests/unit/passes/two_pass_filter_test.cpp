// What the two-pass filter declares: its nodes, nothing without an aperture, and errors for inputs that do
// not fit.
#include "passes/two_pass_filter/two_pass_filter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "passes/registry/registry.h"
#include "rendergraph/compiler.h"
#include "rendergraph/declare/declaration.h"
#include "rendergraph/error.h"

namespace lensgraph {

namespace {

using testing::ElementsAre;
using testing::HasSubstr;

struct Frame {
  rendergraph::Graph graph;
  passes::DofInputs inputs;

  explicit Frame(VkExtent2D extent = {640, 360}, VkFormat depthFormat = VK_FORMAT_D32_SFLOAT) {
    const rendergraph::AccessState sampled = {.stages = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                                              .access = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
                                              .layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    const rendergraph::ImportedImage host = {
        .image = VK_NULL_HANDLE, .usage = VK_IMAGE_USAGE_SAMPLED_BIT, .before = sampled, .after = sampled};
    const auto desc = [&](VkFormat format) {
      return rendergraph::ImageDesc{.format = format, .width = extent.width, .height = extent.height};
    };
    inputs.extent = extent;
    inputs.lens = {.cocScale = 20.0f,
                   .focusVergence = 0.3f,
                   .maxCocRadius = 1e30f,
                   .vergenceScale = 100.0f,
                   .vergenceOffset = 0.0f};
    inputs.color = graph.importImage("color", desc(VK_FORMAT_R16G16B16A16_SFLOAT), host);
    inputs.depth = graph.importImage("depth", desc(depthFormat), host);
  }

  passes::DofOutputs declare(const passes::ParameterSet& parameters = {}) {
    return passes::findTechnique("two_pass_filter")->configure(parameters)->declare(graph, inputs);
  }

  std::vector<std::string_view> declaredPasses() const {
    std::vector<std::string_view> names;
    for (const auto& pass : graph.declaration().passes) names.push_back(pass.name);
    return names;
  }

  rendergraph::Plan plan() const { return compile(graph.declaration(), {}, rendergraph::NominalDevice{}); }
};

const rendergraph::AccessState kShown = {.stages = VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
                                         .access = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
                                         .layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};

TEST(TwoPassFilter, IsRegisteredWithItsParameters) {
  const auto* technique = passes::findTechnique("two_pass_filter");
  ASSERT_NE(technique, nullptr);
  EXPECT_EQ(technique->input, passes::TechniqueInput::image);
  std::vector<std::string_view> names;
  for (const auto& info : technique->parameters) {
    names.push_back(info.name);
    EXPECT_FALSE(info.unit.empty()) << info.name;
    EXPECT_FALSE(info.description.empty()) << info.name;
    EXPECT_TRUE(passes::check({{std::string(info.name), info.defaultValue}}, technique->parameters).empty());
  }
  EXPECT_THAT(names, ElementsAre("maxRadius", "minRadius", "leakage"));
  EXPECT_EQ(passes::nearestTechniqueName("two_pass_fitler"), "two_pass_filter");
  EXPECT_EQ(passes::findTechnique("two_pass"), nullptr);
}

TEST(TwoPassFilter, DeclaresItsNodes) {
  Frame frame;
  const auto outputs = frame.declare();
  EXPECT_THAT(frame.declaredPasses(),
              ElementsAre("two_pass_filter.clear_statistics", "two_pass_filter.prepare", "two_pass_filter.tiles",
                          "two_pass_filter.reach", "two_pass_filter.vertical", "two_pass_filter.horizontal"));
  const auto& desc = frame.graph.desc(outputs.color);
  EXPECT_EQ(desc.format, VK_FORMAT_R32G32B32A32_SFLOAT);
  EXPECT_EQ(desc.width, 640u);
  EXPECT_EQ(desc.height, 360u);
  EXPECT_TRUE(outputs.statistics);
}

TEST(TwoPassFilter, AlphaAddsNoPass) {
  Frame frame;
  frame.inputs.colorHasAlpha = true;
  frame.graph.exportImage(frame.declare().color, kShown);
  EXPECT_EQ(frame.declaredPasses().size(), 6u);
  EXPECT_EQ(frame.plan().passes.size(), 6u);
}

TEST(TwoPassFilter, WithoutAnApertureItDeclaresNothingAndReturnsItsInput) {
  Frame frame;
  frame.inputs.lens.cocScale = 0.0f;
  const auto outputs = frame.declare();
  EXPECT_TRUE(frame.declaredPasses().empty());
  EXPECT_EQ(outputs.color, frame.inputs.color);
  EXPECT_FALSE(outputs.statistics);
}

TEST(TwoPassFilter, CompilesForEveryDepthFormatAndSize) {
  for (const auto format : {VK_FORMAT_D32_SFLOAT, VK_FORMAT_D24_UNORM_S8_UINT, VK_FORMAT_R32_SFLOAT}) {
    for (const VkExtent2D extent : {VkExtent2D{1, 1}, VkExtent2D{1, 4099}, VkExtent2D{2048, 2048}}) {
      Frame frame(extent, format);
      const auto outputs = frame.declare();
      frame.graph.exportImage(outputs.color, kShown);
      EXPECT_EQ(frame.plan().passes.size(), 6u);
    }
  }
}

TEST(TwoPassFilter, IsCulledWhenNobodyLooks) {
  Frame frame;
  frame.declare();
  EXPECT_TRUE(frame.plan().passes.empty());
}

// Three full-size images, of which the first is free again when the last is written.
TEST(TwoPassFilter, ItsResultReusesTheMemoryOfItsInput) {
  Frame frame;
  frame.graph.exportImage(frame.declare().color, kShown);
  const auto memory = frame.plan().memory;
  const uint64_t image = 640ull * 360 * 16;
  EXPECT_GE(memory.unaliasedBytes, 3 * image);
  EXPECT_LT(memory.peakBytes, 2 * image + (1u << 20));
}

TEST(TwoPassFilter, MissingInputsAreSaidInWords) {
  Frame frame;
  const auto* technique = passes::findTechnique("two_pass_filter");
  EXPECT_TRUE(technique->configure({})->validate(frame.inputs).empty());
  passes::DofInputs nothing;
  const auto problems = technique->configure({})->validate(nothing);
  ASSERT_EQ(problems.size(), 3u);
  for (const auto& problem : problems) EXPECT_FALSE(problem.remedy.empty());
}

TEST(TwoPassFilter, ImagesOfAnotherSizeAreRefused) {
  Frame frame;
  frame.inputs.extent = {320, 180};
  try {
    frame.declare();
    FAIL() << "nothing was thrown";
  } catch (const rendergraph::GraphError& error) {
    EXPECT_EQ(error.misuse(), rendergraph::Misuse::sizeMismatch);
    EXPECT_THAT(error.what(), HasSubstr("640x360"));
    EXPECT_THAT(error.what(), HasSubstr("320x180"));
  }
}

}  // namespace

}  // namespace lensgraph
