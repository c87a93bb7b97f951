// From turns to medians and ratios, and how many views accumulation needs for a quality.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bench_results.h"
#include "engine/error.h"
#include "engine/files/output_file.h"
#include "samples/lensgraph/bench/results/bench_file.h"
#include "samples/lensgraph/bench/results/equal_quality.h"
#include "tests/support/temporary_folder.h"

namespace lensgraph::cli {
namespace {

using cli_test::benchFacts;
using cli_test::benchResults;
using testing::HasSubstr;

const nlohmann::ordered_json& onlyResult(const nlohmann::ordered_json& document, const std::string& program = "this") {
  for (const auto& result : document["shots"].at(0)["results"]) {
    if (result["program"] == program) return result;
  }
  throw std::logic_error("no result");
}

TEST(BenchDocument, RatiosAreThoseWithinEachRound) {
  test::TemporaryFolder folder;
  const auto document = benchResults(folder.path(), benchFacts(), {30.0, 50.0, 40.0}, 35.0, 0.95);
  const auto& result = onlyResult(document);
  EXPECT_EQ(result["cpuMs"]["median"], 40.0);
  EXPECT_EQ(result["cpuMs"]["min"], 30.0);
  EXPECT_EQ(result["cpuMs"]["max"], 50.0);
  // 30/10, 50/10, 40/20: the median of these, while the medians' ratio would be 4.
  EXPECT_EQ(result["ratios"]["pinhole"], 3.0);
  EXPECT_EQ(result["ratioRanges"]["pinhole"], nlohmann::ordered_json({2.0, 5.0}));
  EXPECT_EQ(result["ratios"]["copy"], 40.0);
  EXPECT_EQ(result["ratios"]["programs"]["old"], 1.0);  // 30/60, 50/40, 40/40
  EXPECT_EQ(onlyResult(document, "old")["ratios"]["programs"]["this"], 1.0);
}

TEST(BenchDocument, AccumulationCountsAsManyViewsAsReachTheQuality) {
  test::TemporaryFolder folder;
  const auto document = benchResults(folder.path(), benchFacts(), {40.0, 40.0, 40.0}, 35.0, 0.95);
  const auto& ratios = onlyResult(document)["ratios"];
  // 35 dB lie halfway between 8 and 16 views on a logarithmic scale; a view takes 5 ms.
  EXPECT_NEAR(ratios["accumulationAtPsnr"].get<double>(), 40.0 / (5.0 * 8.0 * std::sqrt(2.0)), 1e-9);
  // 1 - SSIM is .4 / views, so .05 is reached with 8.
  EXPECT_NEAR(ratios["accumulationAtSsim"].get<double>(), 1.0, 1e-9);
}

TEST(BenchDocument, QualityBeyondTheCurveHasNoRatio) {
  for (const nlohmann::ordered_json& psnr : {nlohmann::ordered_json(19.0), nlohmann::ordered_json(41.0),
                                             nlohmann::ordered_json("infinity"), nlohmann::ordered_json()}) {
    test::TemporaryFolder folder;
    const auto document = benchResults(folder.path(), benchFacts(), {40.0, 40.0, 40.0}, psnr, 0.95);
    EXPECT_TRUE(onlyResult(document)["ratios"]["accumulationAtPsnr"].is_null()) << psnr;
  }
}

TEST(BenchDocument, GpusAreComparedByDeviceTime) {
  test::TemporaryFolder folder;
  const auto document = benchResults(folder.path(), benchFacts("discrete"), {30.0, 50.0, 40.0}, 35.0, 0.95);
  // Device times 4, 5, 3 over 2, 1, 1.
  EXPECT_EQ(onlyResult(document)["ratios"]["pinhole"], 3.0);
  EXPECT_EQ(onlyResult(document)["ratioRanges"]["pinhole"], nlohmann::ordered_json({2.0, 5.0}));
}

TEST(BenchDocument, VariantsWithoutAllTheirTurnsAreLeftOut) {
  test::TemporaryFolder folder;
  const auto document = benchResults(folder.path(), benchFacts(), {30.0, 50.0, 40.0}, 35.0, 0.95);
  EXPECT_EQ(document["shots"][0]["results"].size(), 2u);
}

TEST(BenchDocument, IsReadBackAndChecked) {
  test::TemporaryFolder folder;
  const auto document = benchResults(folder.path(), benchFacts(), {30.0, 50.0, 40.0}, 35.0, 0.95);
  engine::writeFile(folder / "bench.json", document.dump());
  EXPECT_EQ(readBenchFile(folder.path()), document);
  EXPECT_EQ(readBenchFile(folder / "bench.json"), document);
  for (const char* pointer :
       {"/format", "/formatVersion", "/device", "/shots/0/sceneHash", "/shots/0/results/0/quality"}) {
    auto broken = document;
    broken[nlohmann::ordered_json::json_pointer(pointer)] = "nonsense";
    if (std::string_view(pointer) == "/shots/0/sceneHash") broken["shots"][0]["sceneHash"] = 4;
    engine::writeFile(folder / "bench.json", broken.dump());
    EXPECT_THROW(readBenchFile(folder.path()), engine::Error) << pointer;
  }
}

TEST(BenchDocument, TheTableHasALineForEachResult) {
  test::TemporaryFolder folder;
  const auto table = benchTable(benchResults(folder.path(), benchFacts(), {30.0, 50.0, 40.0}, "infinity", nullptr));
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 3);
  EXPECT_THAT(table, HasSubstr("\"quad\",64,36,2,\"this\",\"two_pass_filter\""));
  EXPECT_THAT(table, HasSubstr("\"infinity\""));
}

TEST(EqualQuality, IsInterpolatedOverTheLogarithmOfSamples) {
  const CurvePoint curve[] = {{4, 20}, {8, 26}, {16, 25}, {32, 32}};
  EXPECT_EQ(samplesAtQuality(curve, 20), 4);
  EXPECT_NEAR(*samplesAtQuality(curve, 23), 4 * std::sqrt(2.0), 1e-12);
  EXPECT_EQ(samplesAtQuality(curve, 26), 8);  // Where it is first reached, though it falls again.
  EXPECT_NEAR(*samplesAtQuality(curve, 28.5), 16 * std::sqrt(2.0), 1e-12);
  EXPECT_FALSE(samplesAtQuality(curve, 19.9));
  EXPECT_FALSE(samplesAtQuality(curve, 32.1));
  EXPECT_FALSE(samplesAtQuality({}, 20));
  EXPECT_NEAR(ssimDecibels(0.99), 20.0, 1e-9);
  EXPECT_TRUE(std::isinf(ssimDecibels(1.0)));
}

}  // namespace
}  // namespace lensgraph::cli
