// The page of a comparison: its table, and the viewer that it steers.
#include "samples/lensgraph/pages/compare_page.h"

#include <nlohmann/json.hpp>

#include "bench_document.h"
#include "page_test.h"

namespace lensgraph::page_test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

cli::ComparePageContent comparison() {
  const auto figures = [](double psnr, const nlohmann::ordered_json& ssim) {
    return nlohmann::ordered_json{{"psnr", psnr},
                                  {"ssim", ssim},
                                  {"flip", 0.05},
                                  {"relativeRmse", nullptr},
                                  {"masks", {{"nearEdge", {{"psnr", "infinity"}, {"ssim", 0.5}, {"pixels", 12}}}}}};
  };
  const engine::FloatImage half(kPictureWidth, kPictureHeight, 1, 0.5f), whole(kPictureWidth, kPictureHeight, 1, 1.0f);
  return {.title = "Two <b>pictures",
          .program = "lensgraph 0.9.0",
          .referenceName = "truth.exr",
          .reference = plainPicture(60, 120, 180),
          .pictures = {{"first.exr", plainPicture(100, 120, 140), half, figures(30.0, 0.9)},
                       {"second.exr", plainPicture(60, 121, 180), std::nullopt, figures(45.5, nullptr)},
                       {"a third </script>", plainPicture(0, 0, 0), half, nullptr}},
          .masks = {{"nearEdge", whole}, {"inFocus", whole}}};
}

class ComparePage : public PageTest {
 protected:
  void SetUp() override {
    PageTest::SetUp();
    if (IsSkipped() || HasFatalFailure()) return;
    open(cli::comparePage(comparison()));
    ASSERT_TRUE(isReady());
  }

  bool isReady() { return browser().becomesTrue("document.querySelector('#viewer').dataset.ready === 'true'"); }
  json names() {
    return browser().evaluate("[...document.querySelectorAll('#figures tbody tr')].map(r => r.firstChild.textContent)");
  }
};

TEST_F(ComparePage, ShowsTheFiguresOfEveryPicture) {
  EXPECT_EQ(browser().text("h1"), "Two <b>pictures");
  EXPECT_THAT(browser().text("#facts"), HasSubstr("truth.exr"));
  EXPECT_EQ(names(), json({"first.exr", "second.exr", "a third </script>"}));
  const std::string table = browser().text("#figures");
  for (const char* part : {"30.00", "0.9000", "45.50", "0.0500", "∞", "nearEdge pixels", "12"}) {
    EXPECT_THAT(table, HasSubstr(part));
  }
  EXPECT_THAT(table, Not(HasSubstr("RMSE"))) << "nobody measured it";
}

TEST_F(ComparePage, APressedHeadingSortsTheTable) {
  browser().click("#figures [data-column='PSNR, dB']");
  EXPECT_EQ(names(), json({"first.exr", "second.exr", "a third </script>"}));
  browser().click("#figures [data-column='PSNR, dB']");
  EXPECT_EQ(names(), json({"second.exr", "first.exr", "a third </script>"}));
}

TEST_F(ComparePage, ARowAndTheViewerChooseThePicture) {
  const std::string chosen =
      "[document.querySelector('#figures [aria-selected=true] td').textContent, "
      "document.querySelector('#viewer select').value]";
  EXPECT_EQ(browser().evaluate(chosen), json({"first.exr", "0"}));
  browser().click("#figures [data-key='1']");
  ASSERT_TRUE(isReady());
  EXPECT_EQ(browser().evaluate(chosen), json({"second.exr", "1"}));
  EXPECT_EQ(browser().evaluate("document.querySelector('#viewer [data-value=flip]').disabled"), true);
  browser().press("ArrowDown");
  browser().press("Enter");
  ASSERT_TRUE(isReady());
  EXPECT_EQ(browser().evaluate(chosen), json({"a third </script>", "2"}));
  EXPECT_EQ(browser().evaluate("document.querySelector('#viewer [data-value=flip]').disabled"), false);
  browser().choose("#viewer select", "0");
  EXPECT_EQ(browser().evaluate(chosen), json({"first.exr", "0"}));
}

TEST_F(ComparePage, ShowsBothSideBySideWhereThereIsRoom) {
  browser().click("#viewer [data-value=side]");
  browser().hover("#viewer canvas", {0.01, 0.5});
  EXPECT_THAT(browser().text("#viewer .read-out"), HasSubstr("pixel 0, 8"));
  browser().hover("#viewer canvas", {0.99, 0.5});
  EXPECT_THAT(browser().text("#viewer .read-out"), HasSubstr("pixel 23, 8"));
  browser().hover("#viewer canvas", {0.51, 0.5});
  EXPECT_THAT(browser().text("#viewer .read-out"), HasSubstr("pixel 0, 8"));
}

TEST_F(ComparePage, OffersEveryMask) {
  EXPECT_EQ(browser().evaluate("[...document.querySelectorAll('#viewer input[type=checkbox]')].map(i => i.value)"),
            json({"nearEdge", "inFocus"}));
  browser().click("#viewer input[value=inFocus]");
  ASSERT_TRUE(isReady());
  EXPECT_EQ(browser().evaluate("document.querySelector('#viewer input[value=inFocus]').checked"), true);
}

TEST_F(ComparePage, SwitchesBetweenLightAndDark) {
  expectSwitchesBetweenLightAndDark();
}

TEST_F(ComparePage, FollowsTheSystemsColors) {
  expectFollowsTheSystemsColors();
}

TEST_F(ComparePage, FitsNarrowWindows) {
  expectFitsNarrowWindows();
}

}  // namespace
}  // namespace lensgraph::page_test
