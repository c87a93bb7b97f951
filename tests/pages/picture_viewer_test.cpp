// The picture viewer, on the page of a bench: what it draws, pixel by pixel.
#include <nlohmann/json.hpp>

#include "bench_document.h"
#include "page_test.h"
#include "samples/lensgraph/pages/bench_page.h"

namespace lensgraph::page_test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

constexpr char kCanvas[] = "#viewer canvas";

class PictureViewer : public PageTest {
 protected:
  void SetUp() override {
    PageTest::SetUp();
    if (IsSkipped() || HasFatalFailure()) return;
    auto bench = benchDocument(folder().path());
    bench["shots"][0]["maskPictures"] = {{"nearEdge", bench["shots"][0]["reference"]["picture"]}};
    const auto quarter = [](const engine::FloatImage& picture, const engine::FloatImage&, double) {
      return engine::FloatImage(picture.width, picture.height, 1, 0.25f);
    };
    open(cli::benchPage(bench, folder().path(), {.flipMap = quarter}));
    ASSERT_TRUE(isReady());
    browser().click("#chart .point[data-key='this blurred'] .dot");
    ASSERT_TRUE(isReady());
  }

  bool isReady() { return browser().becomesTrue("document.querySelector('#viewer').dataset.ready === 'true'"); }
  void pressMode(const std::string& mode) { browser().click("#viewer [data-value=" + mode + "]"); }

  /// The canvas's color at these shares of its size, as [r, g, b].
  json colorAt(double x, double y) {
    const std::string at = std::to_string(x) + " * canvas.width, " + std::to_string(y) + " * canvas.height";
    return browser().evaluate(
        "(() => { const canvas = document.querySelector('#viewer canvas');"
        "const one = new OffscreenCanvas(1, 1).getContext('2d', { willReadFrequently: true });"
        "one.drawImage(canvas, " +
        at + ", 1, 1, 0, 0, 1, 1); return Array.from(one.getImageData(0, 0, 1, 1).data).slice(0, 3); })()");
  }
  json state(const std::string& name) {
    return browser().evaluate("document.querySelector('#viewer').dataset." + name);
  }

  const json picture_ = {100, 120, 140}, reference_ = {60, 120, 180};
};

TEST_F(PictureViewer, ShowsThePictureLeftAndTheReferenceRightOfADividerThatMoves) {
  EXPECT_EQ(colorAt(0.4, 0.3), picture_);
  EXPECT_EQ(colorAt(0.6, 0.3), reference_);
  browser().drag(kCanvas, {0.5, 0.4}, {0.8, 0.4});
  EXPECT_EQ(colorAt(0.6, 0.3), picture_);
  EXPECT_EQ(colorAt(0.9, 0.3), reference_);
  browser().press("[");
  EXPECT_EQ(colorAt(0.79, 0.3), reference_);
}

TEST_F(PictureViewer, SwitchesBetweenPictureReferenceAndBoth) {
  pressMode("picture");
  EXPECT_EQ(colorAt(0.6, 0.3), picture_);
  pressMode("other");
  EXPECT_EQ(colorAt(0.4, 0.3), reference_);
  pressMode("side");
  EXPECT_EQ(colorAt(0.5, 0.25), picture_);
  EXPECT_EQ(colorAt(0.5, 0.75), reference_);
  browser().hover(kCanvas, {0.99, 0.98});
  EXPECT_THAT(browser().text("#viewer .read-out"), HasSubstr("pixel 23, 15"));
  browser().click(kCanvas);
  browser().press("1");
  EXPECT_EQ(state("mode"), "picture");
  browser().press(" ");
  EXPECT_EQ(colorAt(0.5, 0.5), reference_);
  browser().press(" ");
  EXPECT_EQ(colorAt(0.5, 0.5), picture_);
}

TEST_F(PictureViewer, AmplifiesTheDifferenceByTheGain) {
  pressMode("difference");
  EXPECT_EQ(colorAt(0.5, 0.5), json({160, 0, 160}));
  browser().evaluate("document.querySelector('#viewer canvas').focus()");
  browser().press("g");
  EXPECT_EQ(colorAt(0.5, 0.5), json({80, 0, 80}));
  EXPECT_EQ(state("gain"), "2");
}

TEST_F(PictureViewer, ShowsTheFlipMapInColors) {
  pressMode("flip");
  // "magma" at a quarter, as matplotlib has it.
  const json color = colorAt(0.5, 0.5);
  const int magma[] = {81, 18, 124};
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(color[i].get<int>(), magma[i], 3) << color;
}

TEST_F(PictureViewer, ZoomsAndPansAndTellsPixels) {
  browser().hover(kCanvas, {0.01, 0.02});
  EXPECT_THAT(browser().text("#viewer .read-out"), HasSubstr("pixel 0, 0"));
  EXPECT_THAT(browser().text("#viewer .read-out"), HasSubstr("100 120 140"));
  EXPECT_THAT(browser().text("#viewer .read-out"), HasSubstr("60 120 180"));
  EXPECT_THAT(browser().text("#viewer .read-out"), HasSubstr("FLIP: 0.251"));
  const double before = std::stod(state("zoom").get<std::string>());
  browser().click("#viewer [aria-label='zoom in']");
  EXPECT_NEAR(std::stod(state("zoom").get<std::string>()), 2 * before, 0.01);
  pressMode("picture");
  browser().drag(kCanvas, {0.7, 0.7}, {0.2, 0.3});
  browser().hover(kCanvas, {0.5, 0.5});
  // Twice as large, half a canvas to the right is a quarter of the picture: 12 + 6 of 24 px; 8 + 0.4 / 2 · 16 of 16 px.
  EXPECT_THAT(browser().text("#viewer .read-out"), HasSubstr("pixel 18, 11"));
  browser().press("0");
  EXPECT_NEAR(std::stod(state("zoom").get<std::string>()), before, 0.01);
}

TEST_F(PictureViewer, FillsTheScreenAndLeavesIt) {
  browser().click("#viewer [aria-label='full screen']");
  EXPECT_TRUE(browser().becomesTrue("document.fullscreenElement?.id === 'viewer'"));
  browser().evaluate("document.querySelector('#viewer canvas').focus()");
  browser().press("f");
  EXPECT_TRUE(browser().becomesTrue("document.fullscreenElement === null"));
}

TEST_F(PictureViewer, TintsMasksOverThePicture) {
  pressMode("picture");
  browser().click("#viewer input[type=checkbox]");
  ASSERT_TRUE(isReady());
  const json tinted = colorAt(0.5, 0.5);
  EXPECT_GT(tinted[0], picture_[0]);
  browser().click("#viewer input[type=checkbox]");
  ASSERT_TRUE(isReady());
  EXPECT_EQ(colorAt(0.5, 0.5), picture_);
}

TEST_F(PictureViewer, HoldsTwoResultsTogether) {
  browser().choose("#viewer label:nth-of-type(2) select", "this sharp");
  ASSERT_TRUE(isReady());
  EXPECT_EQ(colorAt(0.6, 0.3), json({200, 0, 0}));
  EXPECT_EQ(browser().evaluate("document.querySelector('#viewer [data-value=flip]').disabled"), true);
}

}  // namespace
}  // namespace lensgraph::page_test
