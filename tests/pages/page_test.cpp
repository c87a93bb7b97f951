// Checks that hold for every page: see page_test.h.
#include "page_test.h"

#include <cstdlib>
#include <fstream>

namespace lensgraph::page_test {

using nlohmann::json;

std::optional<Browser> PageTest::browser_;

void PageTest::SetUp() {
  if (!Browser::program()) {
    const char* wanted = std::getenv("LENSGRAPH_ALL_TESTS");
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

json PageTest::colors() {
  return browser_->evaluate(R"js((() => {
    const { color, backgroundColor } = getComputedStyle(document.body);
    const context = new OffscreenCanvas(1, 1).getContext("2d", { willReadFrequently: true });
    const luminance = name => {
      context.fillStyle = name;
      context.fillRect(0, 0, 1, 1);
      const [r, g, b] = Array.from(context.getImageData(0, 0, 1, 1).data).map(v => v / 255)
        .map(v => v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4);
      return 0.2126 * r + 0.7152 * g + 0.0722 * b;
    };
    const [light, dark] = [luminance(color), luminance(backgroundColor)].sort((a, b) => b - a);
    return [color, backgroundColor, (light + 0.05) / (dark + 0.05)];
  })())js");
}

void PageTest::expectSwitchesBetweenLightAndDark() {
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

void PageTest::expectFollowsTheSystemsColors() {
  browser_->open(file_);
  const json light = colors();
  browser_->open(file_, {.prefersDark = true});
  const json dark = colors();
  EXPECT_NE(light[0], dark[0]);
  EXPECT_NE(light[1], dark[1]);
  // What WCAG 2 asks of text at its strictest level.
  EXPECT_GT(light[2].get<double>(), 7.0);
  EXPECT_GT(dark[2].get<double>(), 7.0);
}

}  // namespace lensgraph::page_test
