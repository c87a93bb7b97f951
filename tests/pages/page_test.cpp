// Checks that hold for every page: see page_test.h.
#include "page_test.h"

#include <cstdlib>
#include <fstream>

namespace lensgraph::page_test {

using nlohmann::json;

std::optional<Browser> PageTest::browser_;

void PageTest::SetUp() {
  if (!Browser::program()) {
    const char* wanted = std::getenv("LENSGRAPH_PAGE_TESTS");
    ASSERT_FALSE(wanted != nullptr && std::string_view(wanted) == "required") << "chromium is not installed";
    GTEST_SKIP() << "chromium is not installed (Debian: chromium)";
  }
  if (!browser_) browser_.emplace();
}

void PageTest::TearDown() {
  if (browser_ && !file_.empty()) {
    EXPECT_THAT(browser_->complaints(), testing::IsEmpty());
  }
}

void PageTest::open(std::string_view page, const Window& window) {
  file_ = folder_ / "page.html";
  std::ofstream(file_, std::ios::binary) << page;
  browser_->open(file_, window);
}

void PageTest::expectFitsNarrowWindows() {
  for (const int width : {360, 800}) {
    browser_->open(file_, {.width = width, .height = 800});
    EXPECT_EQ(browser_->evaluate("document.documentElement.scrollWidth"), json(width));
  }
}

void PageTest::expectSwitchesBetweenLightAndDark() {
  const auto colors = [&] {
    return browser_->evaluate(
        "(({ color, backgroundColor }) => [color, backgroundColor])(getComputedStyle(document.body))");
  };
  browser_->open(file_);
  const json light = colors();
  browser_->click("#theme");
  const json dark = colors();
  EXPECT_NE(light[0], dark[0]);
  EXPECT_NE(light[1], dark[1]);
  browser_->click("#theme");
  EXPECT_EQ(colors(), light);
  browser_->open(file_, {.prefersDark = true});
  EXPECT_EQ(colors(), dark);
  browser_->click("#theme");
  EXPECT_EQ(colors(), light);
}

}  // namespace lensgraph::page_test
