// The page of a capture that the program itself has made.
#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "page_test.h"
#include "samples/lensgraph/pages/embedded_page.h"

namespace lensgraph::page_test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class CapturePage : public PageTest {
 protected:
  void SetUp() override {
    PageTest::SetUp();
    if (IsSkipped() || HasFatalFailure()) return;
    if (cli::dagreScript().empty()) GTEST_SKIP() << "the program was built without dagre";
    if (page_.empty()) makePage();
    ASSERT_FALSE(page_.empty());
    open(page_);
  }

  /// Renders a sample scene, and makes the page of its capture; once for all tests.
  void makePage() {
    const std::string program = LENSGRAPH_PROGRAM, quiet = " >/dev/null 2>&1";
    const std::string capture = (folder() / "capture.json").string(), page = (folder() / "capture.html").string();
    const std::string render = program + " render " LENSGRAPH_SOURCE_DIR "/samples/scenes/railing_text_near.json" +
                               " --technique two_pass_filter --size 64x36 --capture " + capture + " -o " +
                               (folder() / "picture.png").string() + quiet;
    ASSERT_EQ(std::system(render.c_str()), 0) << render;
    ASSERT_EQ(std::system((program + " capture-view " + capture + " -o " + page + quiet).c_str()), 0);
    std::ifstream captureStream(capture), pageStream(page, std::ios::binary);
    passes_ = json::parse(captureStream).at("graph").at("passes");
    page_ = std::string{std::istreambuf_iterator<char>(pageStream), {}};
  }

  /// What the elements of that selector say, in order.
  json texts(const std::string& selector) {
    return browser().evaluate("[...document.querySelectorAll('" + selector + "')].map(e => e.textContent)");
  }

  static std::string page_;
  static json passes_;
};

std::string CapturePage::page_;
json CapturePage::passes_;

TEST_F(CapturePage, DrawsGraphTimesLifetimesAndMemory) {
  EXPECT_THAT(browser().text("h1"), HasSubstr("two_pass_filter on railing_text_near"));
  EXPECT_EQ(texts("#graph g[data-step]").size(), passes_.size());
  EXPECT_EQ(texts("#times g[data-step]").size(), passes_.size());
  EXPECT_EQ(texts("#passes tbody tr").size(), passes_.size());
  EXPECT_GT(texts("#lifetimes rect").size(), 2u);
  EXPECT_GT(texts("#memory svg rect").size(), 1u);
}

TEST_F(CapturePage, OrdersPassesByTimeWhenAsked) {
  const std::string order = "[...document.querySelectorAll('#times g[data-step]')].map(g => Number(g.dataset.step))";
  std::vector<std::pair<double, int>> byTime;
  for (std::size_t i = 0; i < passes_.size(); ++i) {
    byTime.push_back({-passes_[i].at("gpuMs").at("median").get<double>(), static_cast<int>(i)});
  }
  std::sort(byTime.begin(), byTime.end());
  json executed = json::array(), longestFirst = json::array();
  for (std::size_t i = 0; i < byTime.size(); ++i) {
    executed.push_back(i);
    longestFirst.push_back(byTime[i].second);
  }
  EXPECT_EQ(browser().evaluate(order), executed);
  browser().click("#by-time");
  EXPECT_EQ(browser().evaluate(order), longestFirst);
  browser().click("#by-order");
  EXPECT_EQ(browser().evaluate(order), executed);
}

TEST_F(CapturePage, APressedHeadingSortsTheTable) {
  const json before = texts("#passes tbody td:first-child");
  browser().click("#passes th:first-child");
  json reversed = json::array();
  for (auto name = before.rbegin(); name != before.rend(); ++name) reversed.push_back(*name);
  EXPECT_EQ(texts("#passes tbody td:first-child"), reversed);
}

TEST_F(CapturePage, HoveringAPassTellsAboutItAndMarksItEverywhere) {
  browser().hover("#passes tbody tr:first-child");
  EXPECT_EQ(browser().evaluate("getComputedStyle(document.querySelector('#tip')).visibility"), "visible");
  EXPECT_THAT(browser().text("#tip"), HasSubstr(passes_[0].at("name").get<std::string>()));
  EXPECT_EQ(browser().evaluate("document.querySelectorAll('.mark[data-step=\"0\"]').length"), 3);
  browser().hover("h1");
  EXPECT_EQ(browser().evaluate("getComputedStyle(document.querySelector('#tip')).visibility"), "hidden");
}

TEST_F(CapturePage, TheGraphMovesAndGrows) {
  const std::string transform = "document.querySelector('#graph svg > g').getAttribute('transform')";
  const json before = browser().evaluate(transform);
  browser().drag("#graph svg", {0.02, 0.05}, {0.1, 0.2});
  EXPECT_NE(browser().evaluate(transform), before);
}

TEST_F(CapturePage, FollowsTheSystemsColors) {
  expectFollowsTheSystemsColors();
}

TEST_F(CapturePage, FitsNarrowWindows) {
  expectFitsNarrowWindows();
}

}  // namespace
}  // namespace lensgraph::page_test
