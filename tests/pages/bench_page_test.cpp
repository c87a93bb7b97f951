// The page of a bench: its charts, tables and choices.
#include "samples/lensgraph/pages/bench_page.h"

#include <nlohmann/json.hpp>

#include "bench_document.h"
#include "page_test.h"

namespace lensgraph::page_test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

class BenchPage : public PageTest {
 protected:
  void SetUp() override {
    PageTest::SetUp();
    if (IsSkipped() || HasFatalFailure()) return;
    open(cli::benchPage(benchDocument(folder().path()), folder().path()));
    ASSERT_TRUE(browser().becomesTrue("document.querySelector('#viewer').dataset.ready === 'true'"));
  }

  /// The keys of the chart's points, from left to right.
  json pointKeys() {
    return browser().evaluate(
        "[...document.querySelectorAll('#chart .point')].map(p => [p.querySelector('.halo').cx.baseVal.value, "
        "p.dataset.key]).sort((a, b) => a[0] - b[0]).map(p => p[1])");
  }
  json selectedKeys() {
    return browser().evaluate(
        "[document.querySelector('#chart .point[aria-pressed=true]')?.dataset.key, "
        "document.querySelector('#figures tr[aria-selected=true]')?.dataset.key, "
        "document.querySelector('#viewer select').value]");
  }
  /// A column of the figures' table, from above.
  json column(int index) {
    return browser().evaluate("[...document.querySelectorAll('#figures tbody tr')].map(r => r.children[" +
                              std::to_string(index) + "].firstChild.textContent)");
  }
};

TEST_F(BenchPage, ShowsDeviceProgramsAndSettings) {
  const std::string head = browser().text("header");
  for (const char* part : {"Bench small", "A </script> device (cpu)", "Mesa 22.3.6", "AMD EPYC 7B13, 2 cores",
                           "2026-12-01", "lensgraph 0.9.0, ec59a42", "lensgraph 0.8.0, 08b1ff7", "1024 lens samples"}) {
    EXPECT_THAT(head, HasSubstr(part));
  }
  EXPECT_THAT(browser().text("#shot-facts"), HasSubstr("5,230"));
}

TEST_F(BenchPage, DrawsAPointPerVariantTheFrontAndAccumulation) {
  EXPECT_EQ(pointKeys(),
            json({"this sharp", "this blurred", "old blurred", "this traced rays=8", "this traced rays=32"}));
  EXPECT_EQ(browser().evaluate("document.querySelectorAll('#chart .step').length"), 4);
  EXPECT_EQ(browser().evaluate("document.querySelector('#chart .step text').textContent"), "4");
  // The view of accumulation takes as long as a pinhole frame: 4 views at 4, left of the variant at 5.
  EXPECT_EQ(
      browser().evaluate("(() => { const x = e => e.getBoundingClientRect().left, all = s => "
                         "[...document.querySelectorAll(s)]; const points = all('#chart .point .halo').map(x).sort((a, "
                         "b) => a - b), steps = all('#chart .step circle:first-of-type').map(x); return [steps[0] > "
                         "points[1], steps[0] < points[3], steps[3] > points[4]]; })()"),
      json({true, true, true}));
  // A staircase of two steps and a way to the right: as many levels as variants on the front.
  EXPECT_EQ(
      browser().evaluate("new Set(document.querySelector('#chart .front').getAttribute('d').match(/,[0-9.]+/g)).size"),
      3);
}

TEST_F(BenchPage, AnotherAxisChangesTheChart) {
  const std::string front = "document.querySelector('#chart .front').getAttribute('d')";
  const json before = browser().evaluate(front);
  browser().choose("#quality-axis", "ssim");
  EXPECT_THAT(browser().text("#chart"), HasSubstr("SSIM"));
  EXPECT_NE(browser().evaluate(front), before);
  browser().choose("#time-axis", "accumulationAtPsnr");
  EXPECT_THAT(browser().text("#chart"), HasSubstr("accumulation at equal PSNR"));
  EXPECT_EQ(pointKeys(), json({"this blurred", "old blurred", "this traced rays=8", "this traced rays=32"}));
  browser().choose("#time-axis", "program old");
  EXPECT_EQ(pointKeys(), json({"this blurred"}));
  browser().choose("#time-axis", "wallMs");
  browser().choose("#mask", "nearEdge");
  EXPECT_THAT(browser().text("#chart"), HasSubstr("SSIM, nearEdge"));
  EXPECT_EQ(browser().evaluate("document.querySelectorAll('#chart .step').length"), 0);
  EXPECT_EQ(browser().evaluate("document.querySelector('#quality-axis option[value=flip]').disabled"), true);
  browser().choose("#mask", "highlight");
  EXPECT_THAT(browser().text("#chart"), HasSubstr("No variant has both figures here."));
}

TEST_F(BenchPage, LowerFlipIsUp) {
  browser().choose("#quality-axis", "flip");
  EXPECT_EQ(browser().evaluate("(() => { const y = key => document.querySelector(`#chart [data-key=\"${key}\"] .halo`)"
                               ".cy.baseVal.value; return y('this traced rays=32') < y('this sharp'); })()"),
            true);
}

TEST_F(BenchPage, AClickedPointSelectsTheVariantEverywhere) {
  browser().click("#chart .point[data-key='this blurred'] .dot");
  EXPECT_EQ(selectedKeys(), json({"this blurred", "this blurred", "this blurred"}));
  EXPECT_THAT(browser().text("#passes-title"), HasSubstr("blurred"));
  EXPECT_EQ(browser().text("#passes tbody tr:nth-child(2) th"), "spread <wide>");
  browser().click("#figures tr[data-key='this traced rays=8']");
  EXPECT_EQ(selectedKeys(), json({"this traced rays=8", "this traced rays=8", "this traced rays=8"}));
  browser().choose("#viewer select", "this sharp");
  EXPECT_EQ(selectedKeys(), json({"this sharp", "this sharp", "this sharp"}));
  // One without a picture and without passes.
  browser().click("#chart .point[data-key='old blurred'] .dot");
  EXPECT_EQ(selectedKeys(), json({"old blurred", "old blurred", "old blurred"}));
  EXPECT_THAT(browser().text("#passes"), HasSubstr("Not measured"));
  EXPECT_TRUE(browser().becomesTrue(
      "document.querySelector('#viewer .read-out').innerText.startsWith('No picture of blurred')"));
}

TEST_F(BenchPage, KeysGoFromPointToPointAndSelect) {
  browser().click("#chart .point[data-key='this sharp'] .dot");
  browser().hover("#passes-title");
  browser().press("ArrowRight");
  EXPECT_EQ(browser().evaluate("document.activeElement.dataset.key"), "this blurred");
  EXPECT_EQ(browser().evaluate("getComputedStyle(document.querySelector('#tip')).visibility"), "visible");
  EXPECT_THAT(browser().text("#tip"), HasSubstr("30.00"));
  browser().press("Enter");
  EXPECT_EQ(selectedKeys(), json({"this blurred", "this blurred", "this blurred"}));
  EXPECT_EQ(browser().evaluate("document.activeElement.dataset.key"), "this blurred");
}

TEST_F(BenchPage, HoveringTellsThePointsFigures) {
  browser().hover("#chart .point[data-key='this traced rays=32'] .dot");
  EXPECT_EQ(browser().evaluate("getComputedStyle(document.querySelector('#tip')).visibility"), "visible");
  for (const char* part : {"traced, rays 32", "10.0", "40.00", "1.25 × accumulation at equal PSNR"}) {
    EXPECT_THAT(browser().text("#tip"), HasSubstr(part));
  }
  browser().hover("h1");
  EXPECT_EQ(browser().evaluate("getComputedStyle(document.querySelector('#tip')).visibility"), "hidden");
}

TEST_F(BenchPage, APressedHeadingSortsTheTable) {
  EXPECT_EQ(column(2), json({"1.00", "2.00", "4.00", "5.00", "10.0"}));
  browser().click("#figures [data-column='PSNR, dB']");
  EXPECT_EQ(column(2), json({"1.00", "5.00", "2.00", "4.00", "10.0"}));
  browser().click("#figures [data-column='PSNR, dB']");
  EXPECT_EQ(column(2), json({"10.0", "2.00", "4.00", "5.00", "1.00"}));
  EXPECT_EQ(browser().evaluate("document.querySelector('#figures th[aria-sort=descending]').innerText.slice(0, 4)"),
            "PSNR");
  // Absent figures come last, whichever way.
  browser().click("#figures [data-column^='×'][data-column$='PSNR']");
  EXPECT_EQ(column(2), json({"2.00", "4.00", "5.00", "10.0", "1.00"}));
  browser().click("#figures [data-column^='×'][data-column$='PSNR']");
  EXPECT_EQ(column(2), json({"10.0", "5.00", "4.00", "2.00", "1.00"}));
  EXPECT_EQ(browser().evaluate("document.querySelector('#figures td:nth-child(3) small').textContent"), "9.00 … 12.0");
}

TEST_F(BenchPage, ButtonsShowAndHideColumnsTechniquesAndPrograms) {
  const std::string headings = "document.querySelector('#figures thead').innerText";
  EXPECT_EQ(browser().evaluate(headings + ".includes('graph memory')"), false);
  browser().click("#figure-groups button:last-child");
  EXPECT_EQ(browser().evaluate(headings + ".includes('graph memory')"), true);
  browser().click("#legend [data-value=traced]");
  EXPECT_EQ(pointKeys(), json({"this sharp", "this blurred", "old blurred"}));
  browser().click("#legend [data-value=old]");
  EXPECT_EQ(pointKeys(), json({"this sharp", "this blurred"}));
  EXPECT_EQ(column(2), json({"1.00", "2.00"}));
  browser().click("#legend [data-value=traced]");
  EXPECT_EQ(pointKeys().size(), 4u);
}

TEST_F(BenchPage, ACardChoosesTheShot) {
  browser().click("#cards [data-shot='1']");
  EXPECT_EQ(pointKeys(), json({"this sharp"}));
  EXPECT_THAT(browser().text("#shot-facts"), HasSubstr("room.json"));
  EXPECT_EQ(browser().evaluate("document.querySelector('#shot').value"), "1");
  EXPECT_THAT(column(2), json({"1.00"}));
  EXPECT_THAT(browser().text("#figures"), HasSubstr("∞"));
  browser().choose("#shot", "0");
  EXPECT_EQ(pointKeys().size(), 5u);
}

TEST_F(BenchPage, TheOverviewHoldsAFigureOfEveryVariantOnEveryShot) {
  browser().click("#matrix-box summary");
  browser().choose("#matrix-figure", "pinhole");
  EXPECT_EQ(
      browser().evaluate("[...document.querySelectorAll('#matrix tbody tr:nth-child(2) td')].map(c => c.innerText)"),
      json({"blurred (this)", "–", "2.00", "–"}));
  EXPECT_EQ(
      browser().evaluate("[...document.querySelectorAll('#matrix tbody tr:nth-child(1) td')].map(c => c.innerText)"),
      json({"sharp (this)", "1.00", "1.00", "1.00"}));
}

TEST_F(BenchPage, SwitchesBetweenLightAndDark) {
  expectSwitchesBetweenLightAndDark();
}

TEST_F(BenchPage, FollowsTheSystemsColors) {
  expectFollowsTheSystemsColors();
}

TEST_F(BenchPage, FitsNarrowWindows) {
  expectFitsNarrowWindows();
}

TEST_F(BenchPage, DrawsWhatIsThereWhenFiguresAreAbsent) {
  auto bench = benchDocument(folder().path());
  auto& shot = bench["shots"][0];
  shot["reference"]["picture"] = "absent.exr";
  shot["units"] = {{"pinhole", nullptr}, {"copy", nullptr}, {"accumulationView", nullptr}};
  shot["accumulation"][1]["psnr"] = nullptr;
  for (auto& [name, value] : shot["results"][1].items()) {
    if (name != "id" && name != "program" && name != "technique") value = nullptr;
  }
  shot["results"][3]["quality"]["psnr"] = "nan";
  shot["results"][4]["ratios"]["pinhole"] = nullptr;
  bench["device"] = nullptr;
  bench["shots"][1]["results"] = nlohmann::ordered_json::array();
  open(cli::benchPage(bench, folder().path()));
  ASSERT_TRUE(browser().becomesTrue("document.querySelector('#viewer').dataset.ready === 'true'"));
  EXPECT_EQ(pointKeys(), json({"this sharp", "old blurred"}));
  browser().click("#figures tr[data-key='this blurred']");
  EXPECT_THAT(browser().text("#figures tr[data-key='this blurred']"), HasSubstr("–"));
  EXPECT_THAT(browser().text("body"), Not(HasSubstr("NaN")));
  EXPECT_THAT(browser().text("body"), Not(HasSubstr("undefined")));
  browser().click("#cards [data-shot='1']");
  EXPECT_THAT(browser().text("#chart"), HasSubstr("No variant"));
}

}  // namespace
}  // namespace lensgraph::page_test
