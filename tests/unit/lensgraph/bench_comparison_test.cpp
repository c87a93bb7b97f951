// Two benchmarks held together: ratios, regressions, and what cannot be compared.
#include "samples/lensgraph/bench/results/bench_comparison.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bench_results.h"
#include "engine/error.h"
#include "tests/support/temporary_folder.h"

namespace lensgraph::cli {
namespace {

using cli_test::benchFacts;
using nlohmann::ordered_json;
using testing::HasSubstr;

ordered_json results(const std::vector<double>& cpuMs = {40.0, 40.0, 40.0}, const ordered_json& psnr = 35.0,
                     const ordered_json& ssim = 0.95) {
  test::TemporaryFolder folder;
  return cli_test::benchResults(folder.path(), benchFacts(), cpuMs, psnr, ssim);
}

BenchComparison compare(const ordered_json& before, const ordered_json& after, const BenchTolerances& tolerances = {}) {
  return compareBenches(before, after, tolerances, "A", "B");
}

std::string refusal(const ordered_json& after, const BenchTolerances& tolerances = {}) {
  try {
    compare(results(), after, tolerances);
  } catch (const engine::Error& error) {
    EXPECT_EQ(error.kind(), engine::ErrorKind::badInput);
    return error.what();
  }
  return "no error";
}

TEST(BenchComparison, FindsNothingBetweenLikeBenchmarks) {
  const auto comparison = compare(results(), results());
  EXPECT_FALSE(comparison.hasRegression());
  ASSERT_EQ(comparison.results.size(), 1u);  // Other programs' results are not of what changed.
  EXPECT_EQ(comparison.results[0].time->median, 1.0);
  EXPECT_EQ(comparison.results[0].psnrChange, 0.0);
}

TEST(BenchComparison, TellsRatiosWithTheirSpread) {
  const auto comparison = compare(results({40.0, 42.0, 50.0}), results({80.0, 84.0, 90.0}));
  const auto& time = *comparison.results[0].time;
  EXPECT_EQ(time.median, 2.0);
  EXPECT_EQ(time.lowest, 80.0 / 50.0);
  EXPECT_EQ(time.highest, 90.0 / 40.0);
  EXPECT_TRUE(comparison.results[0].isSlower);
  EXPECT_FALSE(compare(results({40.0, 42.0, 50.0}), results({80.0, 84.0, 90.0}), {.timeRatio = 2.1}).hasRegression());
}

TEST(BenchComparison, FallingQualityIsARegression) {
  EXPECT_TRUE(compare(results(), results({40, 40, 40}, 34.9)).hasRegression());
  EXPECT_FALSE(compare(results(), results({40, 40, 40}, 34.9), {.psnr = 0.2}).hasRegression());
  EXPECT_FALSE(compare(results(), results({40, 40, 40}, 35.1)).hasRegression());
  EXPECT_TRUE(compare(results(), results({40, 40, 40}, 35.0, 0.94)).hasRegression());
  EXPECT_TRUE(compare(results({40, 40, 40}, "infinity"), results()).hasRegression());
  EXPECT_FALSE(compare(results(), results({40, 40, 40}, "infinity")).hasRegression());
  EXPECT_TRUE(compare(results(), results({40, 40, 40}, nullptr)).hasRegression());
}

TEST(BenchComparison, TimesCanBeMultiplesOfAUnit) {
  auto slowMachine = results({120.0, 120.0, 120.0});
  slowMachine["host"]["processor"] = "another";
  slowMachine["shots"][0]["results"][0]["unitMs"]["accumulationView"] = 15.0;
  const auto comparison = compare(results(), slowMachine, {.unit = "accumulationView"});
  EXPECT_EQ(comparison.results[0].time->median, 1.0);
  EXPECT_FALSE(comparison.hasRegression());
  EXPECT_THAT(refusal(slowMachine), testing::AllOf(HasSubstr("host.processor"), HasSubstr("--unit")));
}

TEST(BenchComparison, RefusesWhatIsNotAlike) {
  const auto with = [](const char* pointer, const ordered_json& value) {
    auto document = results();
    document[ordered_json::json_pointer(pointer)] = value;
    return document;
  };
  EXPECT_THAT(refusal(with("/device/name", "another")), HasSubstr("device.name"));
  EXPECT_THAT(refusal(with("/device/driver", "another")), HasSubstr("device.driver"));
  EXPECT_THAT(refusal(with("/settings/exposureEv", 1.0)), HasSubstr("settings.exposureEv"));
  EXPECT_THAT(refusal(with("/shots/0/sceneHash", "4567")), HasSubstr("quad.sceneHash"));
  EXPECT_THAT(refusal(with("/shots/0/reference/kind", "file")), HasSubstr("quad.reference.kind"));
  auto larger = with("/shots/0/width", 128);
  larger["shots"][0]["case"] = "quad_128x36";
  EXPECT_THAT(refusal(larger), HasSubstr("quad.width"));
}

TEST(BenchComparison, NamesWhatOnlyOneOfThemHas) {
  const auto withMore = [](const char* name) {
    auto document = results();
    auto more = document["shots"][0]["results"][0];
    more["id"] = name;
    document["shots"][0]["results"].push_back(more);
    return document;
  };
  const auto comparison = compare(withMore("one"), withMore("another"));
  EXPECT_THAT(comparison.onlyBefore, testing::ElementsAre("quad_64x36 one"));
  EXPECT_THAT(comparison.onlyAfter, testing::ElementsAre("quad_64x36 another"));
  EXPECT_FALSE(comparison.hasRegression());
  EXPECT_TRUE(compare(withMore("one"), results(), {.mustBeComplete = true}).hasRegression());
  EXPECT_FALSE(compare(results(), withMore("one"), {.mustBeComplete = true}).hasRegression());
}

TEST(BenchComparison, NothingInCommonCannotBeCompared) {
  auto after = results();
  after["shots"][0]["results"] = ordered_json::array();
  EXPECT_THAT(refusal(after), HasSubstr("shots"));
}

TEST(BenchComparison, SizesThatOnlyOneOfThemHasAreNamed) {
  auto both = results();
  both["shots"].push_back(both["shots"][0]);
  both["shots"][1]["case"] = "quad_128x72";
  both["shots"][1]["width"] = 128;
  EXPECT_THAT(compare(both, results()).onlyBefore, testing::ElementsAre("quad_128x72 two_pass_filter"));
  EXPECT_THAT(compare(results(), both).onlyAfter, testing::ElementsAre("quad_128x72 two_pass_filter"));
}

TEST(BenchComparison, ALostTimeIsARegression) {
  auto after = results();
  after["shots"][0]["results"][0]["cpuMs"] = nullptr;
  EXPECT_TRUE(compare(results(), after).hasRegression());
}

TEST(BenchComparison, MergedBenchmarksHaveTheProcessorsOfAllParts) {
  auto merged = results();
  merged["hosts"] = {{{"processor", "a processor"}}, {{"processor", "another"}}};
  EXPECT_THAT(refusal(merged), HasSubstr("host.processor"));
  EXPECT_FALSE(compare(results(), merged, {.unit = "pinhole"}).hasRegression());
}

}  // namespace
}  // namespace lensgraph::cli
