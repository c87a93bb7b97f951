// The demo's page: its pictures load, and its slider moves.
#include "samples/lensgraph/pages/demo_page.h"

#include <nlohmann/json.hpp>

#include "bench_document.h"
#include "engine/image/image_io.h"
#include "page_test.h"

namespace lensgraph::page_test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class DemoPage : public PageTest {
 protected:
  void SetUp() override {
    PageTest::SetUp();
    if (IsSkipped() || HasFatalFailure()) return;
    cli::DemoScene scene{.id = "street", .name = "A <street>", .reference = "reference.png", .results = {}};
    scene.width = kPictureWidth;
    scene.height = kPictureHeight;
    engine::writeImage(folder() / "reference.png", plainPicture(60, 120, 180));
    for (const std::string technique : {"pinhole", "filter"}) {
      scene.results.push_back({.technique = technique,
                               .title = "Title",
                               .picture = technique + ".png",
                               .errorPicture = technique + "_error.png",
                               .gpuMs = 1.25,
                               .wallMs = 2.5,
                               .psnr = 30.5,
                               .ssim = 0.98765});
      engine::writeImage(folder() / (technique + ".png"), plainPicture(100, 120, 140));
      engine::writeImage(folder() / (technique + "_error.png"), plainPicture(0, 0, 0));
    }
    open(cli::demoPage({.device = "a device", .version = "lensgraph 1", .referenceSamples = 64, .scenes = {scene}}));
  }

  json cut() {
    return browser().evaluate(
        "parseFloat(getComputedStyle(document.querySelector('.stage')).getPropertyValue('--cut'))");
  }
};

TEST_F(DemoPage, ShowsFiguresAndLoadsEveryPicture) {
  EXPECT_THAT(browser().text("header"), HasSubstr("a device"));
  EXPECT_THAT(browser().text("#street table"), HasSubstr("30.50"));
  browser().hover("#street .gallery:last-child figure:last-child");
  EXPECT_TRUE(
      browser().becomesTrue("[...document.images].every(image => image.complete && image.naturalWidth === 24)"));
}

TEST_F(DemoPage, TheSliderFollowsThePointerAndKeys) {
  browser().click(".stage", {0.25, 0.5});
  EXPECT_NEAR(cut().get<double>(), 25.0, 0.5);
  browser().drag(".stage", {0.3, 0.5}, {0.75, 0.5});
  EXPECT_NEAR(cut().get<double>(), 75.0, 0.5);
  EXPECT_NEAR(std::stod(browser().evaluate("document.querySelector('.ab input').value").get<std::string>()), 75.0, 0.5);
  const double before = cut();
  browser().click(".ab input", {0.5, 0.5});
  EXPECT_NEAR(cut().get<double>(), 50.0, 2.0);
  EXPECT_NE(cut(), json(before));
}

TEST_F(DemoPage, AnotherPictureCanBeChosenOnEitherSide) {
  browser().choose("select.left", "filter.png");
  EXPECT_EQ(browser().evaluate("document.querySelector('img.over').getAttribute('src')"), "filter.png");
  browser().choose("select.right", "pinhole.png");
  EXPECT_EQ(browser().evaluate("document.querySelector('img.under').getAttribute('src')"), "pinhole.png");
}

TEST_F(DemoPage, FollowsTheSystemsColors) {
  expectFollowsTheSystemsColors();
}

TEST_F(DemoPage, FitsNarrowWindows) {
  expectFitsNarrowWindows();
}

}  // namespace
}  // namespace lensgraph::page_test
