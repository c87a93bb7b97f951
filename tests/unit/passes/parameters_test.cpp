// Checks, parsing and suggestions of technique parameters.
#include "passes/parameters.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace lensgraph {

namespace {

using passes::ParameterSet;
using passes::ParameterValue;
using testing::HasSubstr;

enum class Pattern { sobol, halton };
constexpr std::array<std::string_view, 2> kPatternNames = {"sobol", "halton"};

struct Parameters {
  int samples = 32;
  float radius = 2.5f;
  bool jitter = true;
  Pattern pattern = Pattern::halton;
};

std::span<const passes::Field<Parameters>> fields() {
  static const std::array<passes::Field<Parameters>, 4> all = {
      passes::number<&Parameters::samples>("lensSamples", "", 1, 4096, "how many"),
      passes::number<&Parameters::radius>("radius", "px", 0.5, 64.0, "how far"),
      passes::toggle<&Parameters::jitter>("jitter", "whether"),
      passes::choice<&Parameters::pattern, kPatternNames>("pattern", "which"),
  };
  return all;
}

std::vector<passes::Problem> check(const ParameterSet& set) {
  return passes::check(set, passes::describe<Parameters>(fields()));
}

passes::Problem onlyProblem(const ParameterSet& set) {
  const auto problems = check(set);
  EXPECT_EQ(problems.size(), 1u);
  return problems.empty() ? passes::Problem{} : problems.front();
}

TEST(Parameters, ADescriptionHoldsTheDefaultsOfTheStruct) {
  const auto infos = passes::describe<Parameters>(fields());
  EXPECT_EQ(infos[0].defaultValue, ParameterValue(int64_t{32}));
  EXPECT_EQ(infos[1].defaultValue, ParameterValue(2.5));
  EXPECT_EQ(infos[2].defaultValue, ParameterValue(true));
  EXPECT_EQ(infos[3].defaultValue, ParameterValue(std::string("halton")));
}

TEST(Parameters, ASetOverridesWhatItNamesAndNothingElse) {
  const ParameterSet set = {{"lensSamples", int64_t{7}}, {"pattern", std::string("sobol")}, {"radius", int64_t{3}}};
  EXPECT_TRUE(check(set).empty());
  const auto parameters = passes::fromSet<Parameters>(set, fields());
  EXPECT_EQ(parameters.samples, 7);
  EXPECT_EQ(parameters.radius, 3.0f);
  EXPECT_TRUE(parameters.jitter);
  EXPECT_EQ(parameters.pattern, Pattern::sobol);
}

TEST(Parameters, AnUnknownNameIsAnsweredWithTheNearestOne) {
  const auto problem = onlyProblem({{"lensSample", int64_t{7}}});
  EXPECT_EQ(problem.parameter, "lensSample");
  EXPECT_THAT(problem.remedy, HasSubstr("'lensSamples'"));
}

TEST(Parameters, AnUnknownNameLikeNoneIsAnsweredWithTheList) {
  EXPECT_THAT(onlyProblem({{"bananas", true}}).remedy, HasSubstr("lensSamples, radius, jitter, pattern"));
}

TEST(Parameters, RangesAreInclusiveAndNamedInTheRemedy) {
  EXPECT_TRUE(check({{"radius", 0.5}}).empty());
  EXPECT_TRUE(check({{"radius", 64.0}}).empty());
  EXPECT_THAT(onlyProblem({{"radius", 64.001}}).remedy, HasSubstr("0.5 to 64 px"));
  EXPECT_THAT(onlyProblem({{"lensSamples", int64_t{0}}}).reason, HasSubstr("'0'"));
  EXPECT_EQ(check({{"lensSamples", int64_t{4097}}}).size(), 1u);
}

TEST(Parameters, NumbersMustBeFinite) {
  EXPECT_THAT(onlyProblem({{"radius", std::numeric_limits<double>::quiet_NaN()}}).reason, HasSubstr("finite"));
  EXPECT_THAT(onlyProblem({{"radius", std::numeric_limits<double>::infinity()}}).reason, HasSubstr("finite"));
}

TEST(Parameters, WrongTypesAreRefused) {
  for (const ParameterSet& set : {ParameterSet{{"lensSamples", 3.0}}, ParameterSet{{"lensSamples", true}},
                                  ParameterSet{{"radius", std::string("3")}}, ParameterSet{{"jitter", int64_t{1}}},
                                  ParameterSet{{"pattern", int64_t{1}}}}) {
    EXPECT_THAT(onlyProblem(set).reason, HasSubstr("wrong type"));
  }
}

TEST(Parameters, AChoiceIsAnsweredWithTheNearestOne) {
  EXPECT_THAT(onlyProblem({{"pattern", std::string("hatlon")}}).remedy, HasSubstr("'halton'"));
  EXPECT_THAT(onlyProblem({{"pattern", std::string("x")}}).remedy, HasSubstr("sobol, halton"));
}

TEST(Parameters, EveryProblemIsReported) {
  EXPECT_EQ(check({{"radius", 1e9}, {"lensSamples", int64_t{0}}, {"nothing", true}}).size(), 3u);
}

struct ParseCase {
  std::size_t field;
  const char* text;
  bool good;
  ParameterValue value;
};

TEST(Parameters, TextIsReadAsTheParametersType) {
  const auto infos = passes::describe<Parameters>(fields());
  const std::vector<ParseCase> cases = {
      {0, "12", true, int64_t{12}},
      {0, "+12", true, int64_t{12}},
      {0, "-3", true, int64_t{-3}},
      {0, "1.5", false, {}},
      {0, "", false, {}},
      {0, "12x", false, {}},
      {0, "99999999999999999999", false, {}},
      {0, " 1", false, {}},
      {0, "+-1", false, {}},
      {1, "0.25", true, 0.25},
      {1, "1e2", true, 100.0},
      {1, "7", true, 7.0},
      {1, "nan", false, {}},
      {1, "inf", false, {}},
      {1, "1e999", false, {}},
      {1, "1,5", false, {}},
      {1, "+", false, {}},
      {2, "true", true, true},
      {2, "false", true, false},
      {2, "yes", false, {}},
      {3, "sobol", true, std::string("sobol")},
      {3, "Sobol", false, {}},
  };
  for (const auto& one : cases) {
    ParameterValue value;
    passes::Problem problem;
    EXPECT_EQ(passes::parse(infos[one.field], one.text, value, problem), one.good) << one.text;
    if (one.good) {
      EXPECT_EQ(value, one.value) << one.text;
    } else {
      EXPECT_EQ(problem.parameter, infos[one.field].name);
      EXPECT_FALSE(problem.reason.empty());
      EXPECT_FALSE(problem.remedy.empty());
    }
  }
}

TEST(Parameters, TheNearestNameIsNearAndTheNearest) {
  const std::vector<std::string_view> names = {"pinhole", "accumulation", "two_pass_filter"};
  EXPECT_EQ(passes::nearestName("acumulation", names), "accumulation");
  EXPECT_EQ(passes::nearestName("TwoPassFilter", names), "two_pass_filter");
  EXPECT_EQ(passes::nearestName("pinohle", names), "pinhole");
  EXPECT_EQ(passes::nearestName("raytracer", names), "");
  EXPECT_EQ(passes::nearestName("", names), "");
  EXPECT_EQ(passes::nearestName("pinhole", {}), "");
  const std::vector<std::string_view> close = {"abcdef", "abcdeg"};
  EXPECT_EQ(passes::nearestName("abcdeg", close), "abcdeg");
  const std::vector<std::string_view> third = {"abcdef"};
  EXPECT_EQ(passes::nearestName("abcdxy", third), "abcdef");  // Two of six letters: just near enough …
  EXPECT_EQ(passes::nearestName("abcxyz", third), "");        // … three of six are not.
}

TEST(Parameters, ValuesPrintAsPeopleWriteThem) {
  EXPECT_EQ(passes::toString(ParameterValue(0.1)), "0.1");
  EXPECT_EQ(passes::toString(ParameterValue(64.0)), "64");
  EXPECT_EQ(passes::toString(ParameterValue(int64_t{-4})), "-4");
  EXPECT_EQ(passes::toString(ParameterValue(false)), "false");
}

}  // namespace

}  // namespace lensgraph
