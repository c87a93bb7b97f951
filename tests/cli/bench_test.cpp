// lensgraph bench, bench-merge and compare-bench, and the reports of single pictures as JSON.
#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "engine/image/image_io.h"
#include "program.h"

namespace lensgraph {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class Bench : public cli_test::ProgramTest {
 protected:
  /// A quad whose upper and lower edges are in view and out of focus.
  Bench() {
    writeQuad();
    auto quad = shot();
    quad["camera"]["position"] = {0, 0, 60};
    quad["lens"]["apertureRadius"] = 0.2;
    writeShot(quad);
    writeConfig(json{{"technique", "pinhole"}},
                json{{"technique", "two_pass_filter"}, {"parameters", {{"leakage", {0.2, 0.5}}}}});
  }
  template <class... Variants>
  void writeConfig(const Variants&... variants) const {
    write("bench.json", json{{"shots", {"shot.json"}},
                             {"variants", json::array({json(variants)...})},
                             {"repeats", 2},
                             {"referenceSamples", 256}}
                            .dump());
  }
  json readJson(const std::string& file) const { return json::parse(cli_test::contentOf(folder() / file)); }
  std::vector<std::string> linesOf(const std::string& file) const {
    std::istringstream stream(cli_test::contentOf(folder() / file));
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
  }
};

TEST_F(Bench, ItsFilesSayWhatWasMeasuredWhereAndHow) {
  runWell({"bench", "bench.json", "-o", "out"});
  const json document = readJson("out/bench.json");
  EXPECT_NE(document["device"]["name"], "");
  EXPECT_NE(document["device"]["driver"], "");
  EXPECT_TRUE(document["programs"][0]["commit"].is_string());
  EXPECT_EQ(document["settings"]["repeats"], 2);
  const json& shot = document["shots"].at(0);
  EXPECT_EQ(shot["width"], 32);
  EXPECT_EQ(shot["height"], 24);
  EXPECT_EQ(shot["triangles"], 2);
  EXPECT_EQ(shot["sceneHash"].get<std::string>().size(), 16u);
  EXPECT_EQ(shot["accumulation"].size(), 7u);
  ASSERT_EQ(shot["results"].size(), 3u);
  const json& result = shot["results"][1];
  EXPECT_EQ(result["id"], "two_pass_filter leakage=0.2");
  EXPECT_EQ(result["parameters"]["leakage"], 0.2);
  EXPECT_TRUE(result["parameters"].contains("maxRadius"));
  EXPECT_EQ(result["cpuMs"]["samples"].size(), 2u);
  EXPECT_GT(result["cpuMs"]["median"], 0.0);
  EXPECT_GT(result["ratios"]["copy"], 1.0);
  EXPECT_GT(result["quality"]["psnr"], 15.0);
  EXPECT_LT(shot["results"][0]["quality"]["psnr"], result["quality"]["psnr"]);  // The pinhole's.
  EXPECT_FALSE(result["passes"].empty());
  EXPECT_TRUE(std::filesystem::exists(folder() / "out" / result["picture"].get<std::string>()));
  EXPECT_TRUE(std::filesystem::exists(folder() / "out" / shot["reference"]["picture"].get<std::string>()));
  EXPECT_EQ(linesOf("out/bench.csv").size(), 4u);
  EXPECT_THAT(cli_test::contentOf(folder() / "out/index.html"), HasSubstr("two_pass_filter leakage=0.2"));
}

TEST_F(Bench, GoesOnWhereItWasInterrupted) {
  runWell({"bench", "bench.json", "-o", "out"});
  const auto whole = linesOf("out/journal.jsonl");
  const auto reference = std::filesystem::directory_iterator(folder() / "out/references")->path() / "complete.json";
  const auto rendered = std::filesystem::last_write_time(reference);
  // As a kill leaves it: some records, and a part of the next.
  const std::size_t kept = whole.size() / 2;
  std::string text;
  for (std::size_t line = 0; line < kept; ++line) text += whole[line] + "\n";
  write("out/journal.jsonl", text + whole[kept].substr(0, 20));
  std::filesystem::remove(folder() / "out/bench.json");

  runWell({"bench", "bench.json", "-o", "out"});
  const auto again = linesOf("out/journal.jsonl");
  ASSERT_EQ(again.size(), whole.size());
  EXPECT_TRUE(std::equal(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(kept), again.begin()));
  for (std::size_t line = 1; line < whole.size(); ++line) {
    EXPECT_EQ(json::parse(whole[line])["key"], json::parse(again[line])["key"]);
  }
  EXPECT_EQ(std::filesystem::last_write_time(reference), rendered);
  EXPECT_EQ(readJson("out/bench.json")["shots"][0]["results"].size(), 3u);
}

TEST_F(Bench, TwoRunsMakeTheSamePictures) {
  runWell({"bench", "bench.json", "-o", "one"});
  runWell({"bench", "bench.json", "-o", "two"});
  const json one = readJson("one/bench.json"), two = readJson("two/bench.json");
  for (std::size_t i = 0; i < 3; ++i) {
    const json &first = one["shots"][0]["results"][i], &second = two["shots"][0]["results"][i];
    EXPECT_EQ(first["quality"], second["quality"]);
    const std::string picture = first["picture"];
    EXPECT_TRUE(engine::readImage(folder() / "one" / picture).samples ==
                engine::readImage(folder() / "two" / picture).samples);
  }
  EXPECT_EQ(one["shots"][0]["accumulation"], two["shots"][0]["accumulation"]);
}

TEST_F(Bench, PartsAreMerged) {
  runWell({"bench", "bench.json", "-o", "part1", "--shard", "1/2", "--references", "references"});
  runWell({"bench", "bench.json", "-o", "part2", "--shard", "2/2", "--references", "references"});
  runWell({"bench-merge", "part2", "part1", "-o", "whole"});
  const json whole = readJson("whole/bench.json");
  ASSERT_EQ(whole["shots"].size(), 1u);
  const json& results = whole["shots"][0]["results"];
  ASSERT_EQ(results.size(), 3u);
  for (const json& result : results) {
    EXPECT_TRUE(std::filesystem::exists(folder() / "whole" / result["picture"].get<std::string>()));
  }
  expectError({"bench-merge", "part1", "-o", "half"}, 2, {"part 2/2 is missing"});
  expectError({"bench-merge", "part1", "part1", "-o", "half"}, 2, {"shard", "twice"});
  runWell({"compare-bench", "whole", "whole"});
}

TEST_F(Bench, AnotherBuildTakesTurns) {
  writeConfig(json{{"technique", "pinhole"}});
  runWell({"bench", "bench.json", "-o", "out", "--program", std::string("other=") + LENSGRAPH_PROGRAM});
  const json results = readJson("out/bench.json")["shots"][0]["results"];
  ASSERT_EQ(results.size(), 2u);
  EXPECT_EQ(results[1]["program"], "other");
  EXPECT_EQ(results[0]["quality"]["psnr"], results[1]["quality"]["psnr"]);
  EXPECT_GT(results[0]["ratios"]["programs"]["other"], 0.0);
  expectError({"bench", "bench.json", "-o", "none", "--program", "other"}, 2, {"--program other", "NAME=PATH"});
}

TEST_F(Bench, WhatIsWrongIsNamed) {
  expectError({"bench", "none.json", "-o", "out"}, 2, {"none.json"});
  expectError({"bench", "bench.json", "-o", "out", "--shard", "3/2"}, 2, {"--shard", "3/2"});
  expectError({"bench", "quick", "-o", "out", "--shots", "none"}, 2, {"--shots", "none"});
  writeConfig(json{{"technique", "pinhol"}});
  expectError({"bench", "bench.json", "-o", "out"}, 2, {"variants[0].technique", "pinhole"});
  write("other.json", R"({"shots": ["missing.json"]})");
  expectError({"bench", "other.json", "-o", "out"}, 2, {"shots[0]", "missing.json"});
  write("text", "something");
  writeConfig(json{{"technique", "pinhole"}});
  expectError({"bench", "bench.json", "-o", "text"}, 2, {"--output"});
  expectError({"compare-bench", "shot.json", "bench.json"}, 2, {"shot.json", "format"});
}

TEST_F(Bench, AFolderOfAnotherBenchmarkIsRefused) {
  writeConfig(json{{"technique", "pinhole"}});
  runWell({"bench", "bench.json", "-o", "out"});
  expectError({"bench", "bench.json", "-o", "out", "--repeats", "3"}, 2, {"repeats: is 2"});
  auto lines = linesOf("out/journal.jsonl");
  auto head = json::parse(lines[0]);
  head["commit"] = "0000";
  write("out/journal.jsonl", head.dump() + "\n");
  expectError({"bench", "bench.json", "-o", "out"}, 2, {"commit: is 0000"});
}

TEST_F(Bench, AnEditedSceneIsRefused) {
  writeConfig(json{{"technique", "pinhole"}});
  runWell({"bench", "bench.json", "-o", "out"});
  writeQuad({.depth = 2.5f});
  expectError({"bench", "bench.json", "-o", "out"}, 2, {"journal.jsonl", "shots: is"});
}

TEST_F(Bench, DamagedReferencesAreRenderedAgain) {
  writeConfig(json{{"technique", "pinhole"}});
  runWell({"bench", "bench.json", "-o", "one", "--references", "references"});
  const auto place = std::filesystem::directory_iterator(folder() / "references")->path();
  std::ofstream(place / "views_64.exr", std::ios::trunc);
  const auto again = run({"bench", "bench.json", "-o", "two", "--references", "references"});
  EXPECT_EQ(again.status, 0);
  EXPECT_THAT(again.err, HasSubstr("rendering it again"));
  EXPECT_EQ(readJson("one/bench.json")["shots"][0]["accumulation"],
            readJson("two/bench.json")["shots"][0]["accumulation"]);
}

TEST_F(Bench, MergedPartsKeepTheirOwnUnits) {
  runWell({"bench", "bench.json", "-o", "part1", "--shard", "1/2", "--references", "references"});
  runWell({"bench", "bench.json", "-o", "part2", "--shard", "2/2", "--references", "references"});
  runWell({"bench-merge", "part1", "part2", "-o", "fast"});
  // The same part, measured on a machine of a tenth of the speed.
  json slow = readJson("part2/bench.json");
  for (json& result : slow["shots"][0]["results"]) {
    for (const char* figure : {"median", "min", "max"}) {
      result["cpuMs"][figure] = result["cpuMs"][figure].get<double>() * 10.0;
    }
    for (auto& unit : result["unitMs"]) unit = unit.get<double>() * 10.0;
  }
  write("part2/bench.json", slow.dump());
  runWell({"bench-merge", "part1", "part2", "-o", "slow"});
  const json comparison = json::parse(runWell({"compare-bench", "fast", "slow", "--unit", "pinhole", "--json"}));
  for (const json& result : comparison["results"]) EXPECT_NEAR(result["timeRatio"]["median"], 1.0, 1e-9);

  slow["shots"][0]["sceneHash"] = "0";
  write("part2/bench.json", slow.dump());
  EXPECT_EQ(run({"bench-merge", "part1", "part2", "-o", "other"}).status, 2);
  expectError({"bench-merge", "part1", "part2", "-o", "part1"}, 2, {"--output", "one of the parts"});
}

TEST_F(Bench, OddFilesOfResultsAreRefused) {
  writeConfig(json{{"technique", "pinhole"}});
  runWell({"bench", "bench.json", "-o", "out"});
  const json good = readJson("out/bench.json");
  for (const auto& [pointer, value] : {std::pair<const char*, json>{"/shots/0/results/0/cpuMs", json::object()},
                                       {"/shots/0/results/0/cpuMs/median", "a"},
                                       {"/shots/0/results/0/quality", 4},
                                       {"/shots/0/results", "none"}}) {
    json odd = good;
    odd[json::json_pointer(pointer)] = value;
    write("odd.json", odd.dump());
    expectError({"compare-bench", "odd.json", "out"}, 2, {"odd.json"});
  }
  std::filesystem::create_directory(folder() / "part");
  json odd = good;
  odd["shots"][0]["reference"]["picture"] = "../outside.exr";
  write("part/bench.json", odd.dump());
  const auto outcome = run({"bench-merge", "part", "-o", "merged/below"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("outside the folder"));
}

TEST_F(Bench, ABuildThatTellsNoTimeIsLeftOut) {
  writeConfig(json{{"technique", "pinhole"}});
  const auto program = write("program.sh",
                             "#!/bin/sh\n[ \"$1\" = --version ] && echo lensgraph 0 && exit 0\n"
                             "[ \"$2\" = --help ] && echo --frames-timed && exit 0\n" +
                                 std::string(LENSGRAPH_PROGRAM) + " \"$@\" >/dev/null\necho '{\"warm\": {}}'\n");
  std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  const auto outcome = run({"bench", "bench.json", "-o", "out", "--program", "mute=" + program.string()});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("mute could not be timed"));
  EXPECT_EQ(readJson("out/bench.json")["shots"][0]["results"].size(), 1u);
  EXPECT_FALSE(std::filesystem::exists(folder() / "out/scratch"));
}

TEST_F(Bench, ARegressionIsStatusOne) {
  writeConfig(json{{"technique", "two_pass_filter"}});
  runWell({"bench", "bench.json", "-o", "out"});
  json worse = readJson("out/bench.json");
  worse["shots"][0]["results"][0]["quality"]["psnr"] = 3.0;
  write("worse.json", worse.dump());
  const auto outcome = run({"compare-bench", "out", "worse.json"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.out, HasSubstr("worse"));
  EXPECT_TRUE(json::parse(run({"compare-bench", "out", "worse.json", "--json"}).out)["regression"]);
  worse["shots"][0]["sceneHash"] = "0";
  write("other_scene.json", worse.dump());
  expectError({"compare-bench", "out", "other_scene.json"}, 2, {".sceneHash"});
}

TEST_F(Bench, ReportsAsJsonHoldTimesAndMemoryOfWarmFrames) {
  const json report = json::parse(runWell({"render", "shot.json", "--technique", "two_pass_filter", "-o", "out.exr",
                                           "--depth-out", "depth.exr", "--json", "--frames-timed", "3"}));
  EXPECT_EQ(report["technique"]["name"], "two_pass_filter");
  EXPECT_TRUE(report["technique"]["parameters"].contains("leakage"));
  EXPECT_EQ(report["resolution"], json({32, 24}));
  EXPECT_EQ(report["warm"]["frames"], 3);
  for (const char* clock : {"cpuMs", "wallMs", "gpuMs"}) {
    EXPECT_EQ(report["warm"][clock]["samples"].size(), 3u) << clock;
    EXPECT_GT(report["warm"][clock]["min"], 0.0) << clock;
    EXPECT_GT(report["first"][clock], 0.0) << clock;
  }
  EXPECT_GT(report["memory"]["graphBytes"], 32 * 24 * 16);
  EXPECT_GT(report["memory"]["processBytes"], 10'000'000);
  EXPECT_TRUE(report["warnings"].empty());

  const json applied =
      json::parse(runWell({"apply", "--color", "out.exr", "--depth", "depth.exr", "--fovy", "40", "--aperture-radius",
                           ".1", "--focus", "40", "--technique", "two_pass_filter", "-o", "applied.exr", "--json"}));
  EXPECT_EQ(applied["warm"]["frames"], 1);
  EXPECT_EQ(applied["shot"], "out.exr");
  EXPECT_THAT(applied["notes"].dump(), HasSubstr("depth.exr"));  // Which channels were read.
}

TEST_F(Bench, ReportsInWordsTellTheCostOfAFrame) {
  const auto text = runWell({"render", "shot.json", "--technique", "pinhole", "-o", "out.exr", "--frames-timed", "2"});
  EXPECT_THAT(text, testing::AllOf(HasSubstr("CPU"), HasSubstr("median of 2 warm frames"), HasSubstr("memory")));
}

}  // namespace
}  // namespace lensgraph
