// Configurations of benchmarks: sweeps, shards, names, and what is refused.
#include "samples/lensgraph/bench/bench_config.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "engine/error.h"
#include "samples/host/measures/shot_files.h"
#include "samples/lensgraph/bench/bench_case.h"
#include "samples/lensgraph/bench/names.h"
#include "tests/support/temporary_folder.h"

namespace lensgraph::cli {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* kShot =
    R"({"scene": [{"path": "quad.glb"}], "resolution": [64, 36], "lens": {"focusDistance": 2}})";

class BenchConfigTest : public testing::Test {
 protected:
  BenchConfigTest() {
    for (const char* name : {"one.json", "two.json"}) write(name, kShot);
    write("quad.glb", "");
  }
  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
  BenchConfig read(const std::string& text) const {
    write("bench.json", text);
    return readBenchConfig(folder_ / "bench.json");
  }
  std::string errorOf(const std::string& text) const {
    try {
      read(text);
    } catch (const engine::Error& error) {
      EXPECT_EQ(error.kind(), engine::ErrorKind::badInput);
      return error.what();
    }
    return "no error";
  }
  static std::vector<std::string> idsOf(const BenchConfig& config) {
    std::vector<std::string> ids;
    for (const auto& variant : config.variants) ids.push_back(variant.id);
    return ids;
  }

  test::TemporaryFolder folder_;
};

TEST_F(BenchConfigTest, ArraysOfParametersAreCombined) {
  const auto config = read(R"({"shots": ["one.json"], "variants": [{"technique": "pinhole"},
      {"technique": "multiview_synthesis", "parameters": {"lensSamples": [8, 32], "views": [1, 4], "delta": 2.5}}]})");
  EXPECT_THAT(idsOf(config), ElementsAre("pinhole", "multiview_synthesis delta=2.5 lensSamples=8 views=1",
                                         "multiview_synthesis delta=2.5 lensSamples=8 views=4",
                                         "multiview_synthesis delta=2.5 lensSamples=32 views=1",
                                         "multiview_synthesis delta=2.5 lensSamples=32 views=4"));
}

TEST_F(BenchConfigTest, DefaultsAreEveryTechniqueButTheReference) {
  const auto config = read(R"({"shots": ["one.json"]})");
  EXPECT_EQ(config.name, "bench");
  EXPECT_EQ(config.repeats, 5);
  EXPECT_EQ(config.referenceSamples, 1024);
  EXPECT_THAT(idsOf(config), testing::Contains("two_pass_filter"));
  EXPECT_THAT(idsOf(config), testing::Not(testing::Contains("accumulation")));
}

TEST_F(BenchConfigTest, WhatIsWrongIsNamed) {
  EXPECT_THAT(errorOf(R"({})"), HasSubstr("shots"));
  EXPECT_THAT(errorOf(R"({"shots": []})"), HasSubstr("shots"));
  EXPECT_THAT(errorOf(R"({"shots": ["three.json"]})"), HasSubstr("shots[0]"));
  EXPECT_THAT(errorOf(R"({"shots": [{"shot": "one.json", "reference": "none.exr"}]})"),
              HasSubstr("shots[0].reference"));
  EXPECT_THAT(errorOf(R"({"shots": ["one.json", "one.json"]})"), HasSubstr("twice"));
  EXPECT_THAT(errorOf(R"({"shots": ["one.json"], "repeats": 0})"), HasSubstr("repeats"));
  EXPECT_THAT(errorOf(R"({"shots": ["one.json"], "referenceSamples": 128})"), HasSubstr("referenceSamples"));
  EXPECT_THAT(errorOf(R"({"shots": ["one.json"], "sizes": [[0, 4]]})"), HasSubstr("sizes[0]"));
  EXPECT_THAT(errorOf(R"({"shots": ["one.json"], "sizes": [[4, 4], [4, 4]]})"), HasSubstr("twice"));
  EXPECT_THAT(errorOf(R"({"shots": ["one.json"], "repeat": 2})"), HasSubstr("repeats"));  // The nearest.
  EXPECT_THAT(errorOf(R"({"shots": ["one.json"], "variants": [{"technique": "pinhol"}]})"),
              testing::AllOf(HasSubstr("variants[0].technique"), HasSubstr("pinhole")));
  EXPECT_THAT(errorOf(R"({"shots": ["one.json"], "variants": [{"technique": "two_pass_filter",
                          "parameters": {"leakage": [0.5, -7]}}]})"),
              HasSubstr("variants[0].parameters.leakage"));
  EXPECT_THAT(errorOf(R"({"shots": ["one.json"], "variants": [{"technique": "pinhole"}, {"technique": "pinhole"}]})"),
              HasSubstr("pinhole twice"));
}

TEST_F(BenchConfigTest, FoldersOfShotsAreFoundWithTheirReferences) {
  std::filesystem::create_directory(folder_ / "glass");
  write("glass/shot.json", kShot);
  write("glass/dof.exr", "");
  std::filesystem::create_directory(folder_ / "empty");
  const auto shots = findShots({folder_.path()});
  ASSERT_EQ(shots.size(), 3u);
  EXPECT_EQ(shotId(shots[0].shot), "glass");
  EXPECT_EQ(shots[0].reference, folder_ / "glass/dof.exr");
  EXPECT_EQ(shotId(shots[1].shot), "one");
  EXPECT_FALSE(shots[1].reference);
  EXPECT_THROW(findShots({folder_ / "empty"}), engine::Error);
  EXPECT_THROW(findShots({folder_ / "none"}), engine::Error);
  EXPECT_THROW(findShots({folder_ / "one.json", folder_ / "one.json"}), engine::Error);
}

TEST_F(BenchConfigTest, AnyChangeChangesTheIdentityAndPathsDoNot) {
  const std::vector<std::string> texts = {R"({"shots": ["one.json"]})",
                                          R"({"shots": ["two.json"]})",
                                          R"({"shots": ["one.json"], "repeats": 4})",
                                          R"({"shots": ["one.json"], "sizes": [[8, 8]]})",
                                          R"({"shots": ["one.json"], "exposureEv": 1})",
                                          R"({"shots": ["one.json"], "variants": [{"technique": "pinhole"}]})"};
  std::set<std::string> identities;
  for (const auto& text : texts) identities.insert(identityOf(read(text)).dump());
  EXPECT_EQ(identities.size(), texts.size());
  const auto before = identityOf(read(texts[0])).dump();
  EXPECT_EQ(identityOf(read(R"({"shots": ["./one.json"]})")).dump(), before);
  write("quad.glb", "another scene");
  EXPECT_NE(identityOf(read(texts[0])).dump(), before);
}

TEST_F(BenchConfigTest, BuffersAndImagesBesideAGltfCount) {
  write("scene.gltf", R"({"buffers": [{"uri": "a%20buffer.bin"}], "images": [{"uri": "data:image/png;base64,"}]})");
  write("one.json", R"({"scene": [{"path": "scene.gltf"}], "lens": {"focusDistance": 2}})");
  const auto files = host::filesOf(host::readShot(folder_ / "one.json"));
  ASSERT_EQ(files.size(), 3u);
  EXPECT_EQ(files[2].filename(), "a buffer.bin");
  const auto before = host::hashOfFiles(files);
  write("a buffer.bin", "vertices");
  EXPECT_NE(host::hashOfFiles(files), before);
}

TEST_F(BenchConfigTest, OtherShotsReplaceThoseOfTheFile) {
  write("bench.json", R"({"variants": [{"technique": "pinhole"}]})");
  const auto config = readBenchConfig(folder_ / "bench.json", findShots({folder_ / "two.json"}));
  ASSERT_EQ(config.shots.size(), 1u);
  EXPECT_EQ(shotId(config.shots[0].shot), "two");
}

TEST_F(BenchConfigTest, ShardsTogetherAreTheWhole) {
  const auto config = read(R"({"shots": ["one.json", "two.json"], "sizes": [[16, 9], [32, 18]],
      "variants": [{"technique": "multiview_synthesis", "parameters": {"lensSamples": [1, 2, 3, 4, 5]}}]})");
  std::multiset<std::string> whole, parts;
  const auto collect = [&](const Shard& shard, std::multiset<std::string>& into) {
    for (const auto& each : casesOf(config, shard)) {
      for (const auto& variant : each.variants) into.insert(each.id + " " + variant.id);
    }
  };
  collect({}, whole);
  EXPECT_EQ(whole.size(), 20u);
  for (int index = 1; index <= 7; ++index) collect({index, 7}, parts);
  EXPECT_EQ(parts, whole);
  // A part needs few references: 20 pairs in 7 parts reach over one border of a case at most.
  for (int index = 1; index <= 7; ++index) EXPECT_LE(casesOf(config, {index, 7}).size(), 2u);
}

TEST(Shards, AreReadAndRefused) {
  ASSERT_TRUE(shardFrom("3/8"));
  EXPECT_EQ(shardFrom("3/8")->index, 3);
  EXPECT_EQ(shardFrom("3/8")->count, 8);
  for (const char* text : {"0/8", "9/8", "3", "3/", "/8", "a/b", "1/0", "3/8x", "-1/2", ""}) {
    EXPECT_FALSE(shardFrom(text)) << text;
  }
}

}  // namespace
}  // namespace lensgraph::cli
