// What makeTechnique() makes of a technique's typed functions, and what every entry of the registry promises.
#include "passes/technique.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "passes/registry/registry.h"

namespace lensgraph {

using namespace passes;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pair;

namespace {

struct Parameters {
  int samples = 4;
  double width = 1.0;
};

std::span<const Field<Parameters>> fields() {
  static const std::array all = {number<&Parameters::samples>("samples", "", 1, 64, "how many"),
                                 number<&Parameters::width>("width", "px", 0.0, 8.0, "how wide")};
  return all;
}

/// Shows in the picture's version number what it was given.
DofOutputs declare(rendergraph::Graph&, const DofInputs& inputs, const Parameters& parameters) {
  DofOutputs out;
  out.color = inputs.color;
  out.color.version = static_cast<uint32_t>(parameters.samples);
  return out;
}

std::vector<Problem> validate(const Parameters& parameters, const DofInputs& inputs) {
  if (parameters.samples <= static_cast<int>(inputs.extent.width)) return {};
  return {{"samples", "there are more samples than columns", "set fewer"}};
}

uint32_t frameCount(const Parameters& parameters, const DofInputs&) {
  return static_cast<uint32_t>(parameters.samples) / 2;
}

DofInputs pictures() {
  DofInputs inputs;
  inputs.extent = {16, 16};
  inputs.color = {.resource = 0, .version = 0, .graph = 1};
  inputs.depth = {.resource = 1, .version = 0, .graph = 1};
  return inputs;
}

Technique plain() {
  return makeTechnique<Parameters>({.name = "plain", .fields = fields(), .declare = declare});
}

Technique whole() {
  return makeTechnique<Parameters>({.name = "whole",
                                    .fields = fields(),
                                    .declare = declare,
                                    .validate = validate,
                                    .frameCount = frameCount,
                                    .quick = {.samples = 2},
                                    .quickPixelSamples = 2});
}

}  // namespace

TEST(Technique, TakesItsParametersByName) {
  rendergraph::Graph graph;
  EXPECT_EQ(plain().configure({})->declare(graph, pictures()).color.version, 4u);
  EXPECT_EQ(plain().configure({{"samples", int64_t{9}}})->declare(graph, pictures()).color.version, 9u);
}

TEST(Technique, AConfiguredOneOutlivesItsEntryAndItsSet) {
  rendergraph::Graph graph;
  std::unique_ptr<ConfiguredTechnique> configured;
  {
    const Technique technique = whole();
    ParameterSet set = {{"samples", int64_t{8}}};
    configured = technique.configure(set);
    set.clear();
  }
  EXPECT_EQ(configured->declare(graph, pictures()).color.version, 8u);
  EXPECT_EQ(configured->frameCount(pictures()), 4u);
}

TEST(Technique, NeedsOneExecutionUnlessItSaysOtherwise) {
  EXPECT_EQ(plain().configure({})->frameCount(pictures()), 1u);
  EXPECT_EQ(whole().configure({})->frameCount(pictures()), 2u);
}

TEST(Technique, ChecksItsInputsBeforeItsOwnRules) {
  const auto configured = whole().configure({{"samples", int64_t{32}}});
  const auto own = configured->validate(pictures());
  ASSERT_EQ(own.size(), 1u);
  EXPECT_EQ(own[0].parameter, "samples");
  const auto missing = configured->validate({});
  ASSERT_EQ(missing.size(), 3u) << "color, depth, extent";
  for (const Problem& problem : missing) EXPECT_THAT(problem.parameter, IsEmpty());
  EXPECT_THAT(plain().configure({{"samples", int64_t{32}}})->validate(pictures()), IsEmpty());
}

TEST(Technique, QuickSettingsAreWhatDiffersFromTheDefaults) {
  EXPECT_THAT(plain().quick.parameters, IsEmpty());
  EXPECT_EQ(plain().quick.pixelSamples, 1);
  EXPECT_THAT(whole().quick.parameters, ElementsAre(Pair("samples", ParameterValue(int64_t{2}))));
  EXPECT_EQ(whole().quick.pixelSamples, 2);
}

TEST(Registry, QuickSettingsAreLegal) {
  SceneDraw scene;
  scene.record = [](rendergraph::PassContext&, const SceneDrawCall&) {};
  DofInputs inputs = pictures();
  inputs.scene = &scene;
  for (const Technique& technique : techniques()) {
    EXPECT_THAT(check(technique.quick.parameters, technique.parameters), IsEmpty()) << technique.name;
    EXPECT_THAT(technique.configure(technique.quick.parameters)->validate(inputs), IsEmpty()) << technique.name;
    EXPECT_GE(technique.quick.pixelSamples, 1) << technique.name;
  }
}

TEST(Registry, EveryTechniqueRefusesToWorkOnNothing) {
  for (const Technique& technique : techniques()) {
    const auto problems = technique.configure({})->validate({});
    EXPECT_FALSE(problems.empty()) << technique.name;
    for (const Problem& problem : problems) {
      EXPECT_FALSE(problem.reason.empty()) << technique.name;
      EXPECT_FALSE(problem.remedy.empty()) << technique.name;
    }
  }
}

}  // namespace lensgraph
