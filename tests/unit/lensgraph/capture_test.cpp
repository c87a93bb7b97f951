// Captures read back, compared, and made into a page; without a device.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "engine/error.h"
#include "samples/lensgraph/capture/capture_diff.h"
#include "samples/lensgraph/capture/capture_reader.h"
#include "samples/lensgraph/pages/capture_page.h"

namespace lensgraph {

namespace {

using cli::PassChange;
using cli::TimeChange;
using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

json time(double median, double reach = 0.1) {
  return {{"median", median}, {"min", median - reach}, {"max", median + reach}};
}

json pass(const std::string& name, const json& gpuMs, int bytes = 1000) {
  return {{"name", name},
          {"kind", "compute"},
          {"queue", 0},
          {"gpuMs", gpuMs},
          {"recordMs", time(0.2)},
          {"bytesRead", bytes},
          {"bytesWritten", bytes},
          {"imageBarriers", 1},
          {"bufferBarriers", 0},
          {"barrierBatches", 1},
          {"resolution", {8, 4}},
          {"uses", {{{"resource", 0}, {"usage", "storage"}, {"reads", false}, {"writes", true}}}}};
}

json capture(const std::vector<json>& passes) {
  const json resource = {
      {"name", "image"},  {"origin", "created"}, {"kind", "image"}, {"contentBytes", 128},       {"heap", 0},
      {"offset", 0},      {"size", 256},         {"firstStep", 0},  {"lastStep", passes.size()}, {"format", 109},
      {"extent", {8, 4}}, {"layers", 1},         {"mips", 1}};
  const json graph = {{"timing", "isolated"},
                      {"frames", 5},
                      {"frameGpuMs", time(10)},
                      {"passSumMs", time(10)},
                      {"frameWallMs", time(12)},
                      {"plansReused", 5},
                      {"barrierBatches", 2},
                      {"barriersAtEnd", {{"images", 1}, {"buffers", 0}}},
                      {"memory",
                       {{"peakBytes", 256},
                        {"unaliasedBytes", 256},
                        {"lowerBound", 256},
                        {"heaps", {{{"size", 256}, {"memory", "device"}}}}}},
                      {"passes", passes},
                      {"resources", json::array({resource})},
                      {"edges", json::array()},
                      {"culled", json::array()}};
  return {{"format", "lensgraph capture"},
          {"formatVersion", 1},
          {"program", {{"name", "lensgraph"}, {"version", "1"}, {"commit", ""}}},
          {"device", {{"name", "D"}, {"type", "cpu"}, {"driver", "1"}}},
          {"shot", "a/s.json"},
          {"inputHash", "0"},
          {"resolution", {8, 4}},
          {"lens", {{"apertureRadius", 0.1}, {"focusDistance", "infinity"}}},
          {"technique", {{"name", "t"}, {"parameters", {{"size", 3}}}}},
          {"executions", 1},
          {"gpuMs", time(10)},
          {"wallMs", time(12)},
          {"uninterrupted", nullptr},
          {"graph", graph}};
}

class Captures : public testing::Test {
 protected:
  Captures()
      : file_(std::filesystem::temp_directory_path() / ("lensgraph-capture-" + std::to_string(getpid()) + ".json")) {}
  ~Captures() override { std::filesystem::remove(file_); }
  cli::CaptureFacts read(const json& document) const {
    std::ofstream(file_) << document.dump();
    return cli::readCapture(file_);
  }
  std::string problemOf(const json& document) const {
    try {
      read(document);
    } catch (const engine::Error& error) {
      EXPECT_EQ(error.kind(), engine::ErrorKind::badInput);
      return error.parts().field + ": " + error.parts().reason + " (" + error.parts().remedy + ")";
    }
    return "accepted";
  }

  std::filesystem::path file_;
};

TEST_F(Captures, AreReadBack) {
  const auto facts = read(capture({pass("a", time(4)), pass("b", nullptr)}));
  ASSERT_EQ(facts.passes.size(), 2u);
  EXPECT_EQ(facts.passes[0].gpuMs->median, 4.0);
  EXPECT_FALSE(facts.passes[1].gpuMs) << "not measured";
  EXPECT_EQ(facts.conditions.at("parameter size"), "3");
  EXPECT_EQ(facts.peakBytes, 256u);
}

TEST_F(Captures, FilesThatAreNoCaptureOrABrokenOneAreRefused) {
  const json good = capture({pass("a", time(4))});
  for (const json& document :
       {json::array(), json::object(), json(3), json{{"format", 1}}, json{{"graph", {{"passes", 1}}}}}) {
    EXPECT_THAT(problemOf(document), HasSubstr("is no capture")) << document;
  }
  const auto changed = [&](const char* pointer, const json& value) {
    json document = good;
    document[json::json_pointer(pointer)] = value;
    return problemOf(document);
  };
  EXPECT_EQ(problemOf(good), "accepted");
  EXPECT_THAT(changed("/formatVersion", 2), HasSubstr("version 1 alone"));
  EXPECT_THAT(changed("/graph/passes/0/gpuMs", "fast"), HasSubstr("graph.passes[0].gpuMs"));
  EXPECT_THAT(changed("/graph/passes/0/uses/0/resource", 1), HasSubstr("graph.passes[0].uses[0].resource"));
  EXPECT_THAT(changed("/graph/resources/0/heap", 1), HasSubstr("graph.resources[0].heap"));
  EXPECT_THAT(changed("/graph/resources/0/lastStep", 2), HasSubstr("graph.resources[0].lastStep"));
  EXPECT_THAT(changed("/graph/edges", json::parse(R"([{"from": 0, "to": 7, "resource": 0}])")),
              HasSubstr("graph.edges[0].to"));
  EXPECT_THAT(changed("/graph/memory", nullptr), HasSubstr("graph.memory"));
  EXPECT_THAT(changed("/device", "D"), HasSubstr("device"));
}

std::vector<std::string> order(const cli::CaptureDiff& diff) {
  std::vector<std::string> names;
  for (const PassChange& change : diff.passes) names.push_back((change.changed() ? "!" : "") + change.name);
  return names;
}

TEST_F(Captures, DifferBySizeOfTheChange) {
  const auto before = read(capture({pass("still", time(3)), pass("slower", time(1)), pass("much slower", time(1)),
                                    pass("noisy", time(5, 2)), pass("bytes", time(2)), pass("gone", time(0.4))}));
  const auto after = read(capture({pass("still", time(3)), pass("slower", time(1.5)), pass("much slower", time(9)),
                                   pass("noisy", time(7, 2)), pass("bytes", time(2), 3000), pass("new", time(3))}));
  const auto diff = cli::diffCaptures(before, after);
  EXPECT_THAT(order(diff), ElementsAre("!much slower", "!new", "!slower", "!gone", "!bytes", "noisy", "still"));
  EXPECT_EQ(diff.passes[1].kind, PassChange::Kind::added);
  EXPECT_EQ(diff.passes[3].kind, PassChange::Kind::removed);
  EXPECT_EQ(diff.passes[0].gpuMs.weight, TimeChange::Weight::changed);
  EXPECT_EQ(diff.passes[5].gpuMs.weight, TimeChange::Weight::noise) << "3…7 and 5…9 ms meet";
  EXPECT_DOUBLE_EQ(diff.passes[5].gpuMs.ms(), 2.0);
  const auto text = cli::diffText(diff, "a", "b");
  EXPECT_THAT(text, HasSubstr("1.000 -> 9.000 ms, +8.000 (+800.0 %)\n"));
  EXPECT_THAT(text, HasSubstr("5.000 -> 7.000 ms, +2.000 (+40.0 %), noise"));
  EXPECT_THAT(text, HasSubstr("+ new"));
  EXPECT_THAT(text, HasSubstr("- gone"));
  EXPECT_THAT(text, HasSubstr("passes that changed: 5 of 7"));
  EXPECT_THAT(text, Not(HasSubstr("still")));
  EXPECT_EQ(cli::diffJson(diff)["passes"][0]["name"], "much slower");
  EXPECT_EQ(cli::diffJson(diff)["passes"][5]["gpuMs"]["weight"], "noise");
}

TEST_F(Captures, EqualCapturesDifferInNothing) {
  const auto facts = read(capture({pass("a", time(4)), pass("a", time(2))}));
  const auto diff = cli::diffCaptures(facts, facts);
  EXPECT_THAT(order(diff), ElementsAre("a", "a #2"));
  EXPECT_TRUE(diff.conditions.empty());
  EXPECT_THAT(cli::diffText(diff, "a", "b"), HasSubstr("passes that changed: 0 of 2"));
}

TEST_F(Captures, CapturesOfOneFrameHaveNoSpread) {
  json one = capture({pass("a", time(4, 0))}), other = capture({pass("a", time(5, 0))});
  one["graph"]["frames"] = 1;
  const auto diff = cli::diffCaptures(read(one), read(other));
  EXPECT_EQ(diff.passes[0].gpuMs.weight, TimeChange::Weight::unknown);
  EXPECT_THAT(cli::diffText(diff, "a", "b"), HasSubstr("spread unknown"));
}

TEST_F(Captures, TellDifferentConditions) {
  json other = capture({pass("a", time(4))});
  other["device"]["name"] = "E";
  other["technique"]["parameters"] = {{"size", 4}, {"extra", true}};
  const auto diff = cli::diffCaptures(read(capture({pass("a", time(4))})), read(other));
  std::vector<std::string> told;
  for (const auto& change : diff.conditions) told.push_back(change.what + ": " + change.before + " > " + change.after);
  EXPECT_THAT(told, ElementsAre("device: D > E", "parameter extra:  > true", "parameter size: 3 > 4"));
}

TEST_F(Captures, PageHoldsTheCaptureAndNeedsNothingElse) {
  if (!cli::canMakeCapturePages()) GTEST_SKIP() << "built without d3 and dagre";
  json document = capture({pass("evil </script><b>", time(4))});
  const auto page = cli::capturePage(document);
  // The page is half a megabyte: too long to be printed by a matcher that fails.
  const auto holds = [&](const char* text) { return page.find(text) != std::string::npos; };
  EXPECT_FALSE(holds("</script><b>")) << "a name must not end the element that it stands in";
  const std::string open = "type=\"application/json\">";
  const auto begin = page.find(open) + open.size();
  EXPECT_EQ(json::parse(page.substr(begin, page.find("</script>", begin) - begin)), document);
  for (const auto* loads : {"<script src", "<link", "@import", "url(h", "url(\"", "<img"}) EXPECT_FALSE(holds(loads));
  for (const auto* part : {"d3js.org", "dagre", "</html>"}) EXPECT_TRUE(holds(part)) << part;
  for (const auto* mark : {"/*libraries*/", "/*script*/", "/*capture*/"}) EXPECT_FALSE(holds(mark)) << mark;
}

}  // namespace

}  // namespace lensgraph
