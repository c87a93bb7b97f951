// The demo's page: template, escaping, the files that it names; and the colours of its error pictures.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "samples/lensgraph/error_map.h"
#include "samples/lensgraph/pages/demo_page.h"
#include "samples/lensgraph/pages/page_template.h"

namespace lensgraph {

namespace {

using cli::fillTemplate;
using testing::HasSubstr;
using testing::Not;

TEST(PageTemplate, EscapesValues) {
  EXPECT_EQ(fillTemplate("<b title=\"{{x}}\">", {{"x", "<a href='\"'>&"}}),
            "<b title=\"&lt;a href=&#39;&quot;&#39;&gt;&amp;\">");
}

TEST(PageTemplate, RepeatsSectionsAndFindsOuterValues) {
  EXPECT_EQ(fillTemplate("{{#rows}}{{a}}{{b}};{{/rows}}", {{"b", "B"}, {"rows", {{{"a", 1}}, {{"a", 2}, {"b", "C"}}}}}),
            "1B;2C;");
}

TEST(PageTemplate, NestsSectionsOfOneName) {
  EXPECT_EQ(fillTemplate("{{#x}}[{{#x}}{{y}}{{/x}}]{{/x}}", {{"x", {{{"x", {{{"y", 1}}}}}}}}), "[1]");
}

TEST(PageTemplate, ShowsInvertedSectionsOnlyWhenThereIsNothing) {
  const auto text = "{{#a}}yes{{/a}}{{^a}}no{{/a}}";
  EXPECT_EQ(fillTemplate(text, {{"a", true}}), "yes");
  EXPECT_EQ(fillTemplate(text, {{"a", false}}), "no");
  EXPECT_EQ(fillTemplate(text, {{"a", nlohmann::json::array()}}), "no");
}

TEST(PageTemplate, RefusesMistakes) {
  EXPECT_THROW(fillTemplate("{{absent}}", nlohmann::json::object()), std::logic_error);
  EXPECT_THROW(fillTemplate("{{#a}}", {{"a", true}}), std::logic_error);
  EXPECT_THROW(fillTemplate("{{#a}}{{/b}}", {{"a", true}, {"b", true}}), std::logic_error);
  EXPECT_THROW(fillTemplate("{{/a}}", {{"a", true}}), std::logic_error);
  EXPECT_THROW(fillTemplate("{{a", {{"a", true}}), std::logic_error);
}

cli::DemoReport report() {
  cli::DemoScene scene{.id = "street", .name = "A <street>", .reference = "street/reference.png", .results = {}};
  scene.width = 480;
  scene.height = 270;
  scene.results.push_back({.technique = "pinhole",
                           .title = "Pinhole",
                           .picture = "street/pinhole.png",
                           .errorPicture = "street/pinhole_error.png",
                           .gpuMs = 1.25,
                           .wallMs = 2.5,
                           .psnr = std::numeric_limits<double>::infinity(),
                           .ssim = 0.98765});
  return {.device = "a & b", .version = "lensgraph 1", .referenceSamples = 64, .scenes = {scene}};
}

TEST(DemoPage, ShowsEveryPictureAndNumber) {
  const auto page = cli::demoPage(report());
  for (const auto* part : {"street/reference.png", "street/pinhole.png", "street/pinhole_error.png", "1.25", "2.50",
                           "∞", "0.9877", "A &lt;street&gt;", "a &amp; b", "64"}) {
    EXPECT_THAT(page, HasSubstr(part));
  }
  EXPECT_THAT(page, Not(HasSubstr("{{")));
  EXPECT_THAT(page, Not(HasSubstr("<street>")));
}

TEST(DemoPage, NeedsNothingFromElsewhere) {
  const auto page = cli::demoPage(report());
  EXPECT_THAT(page, Not(HasSubstr("http://")));
  EXPECT_THAT(page, Not(HasSubstr("https://")));
}

TEST(DemoPage, IsMadeOfNoScenesToo) {
  EXPECT_THAT(cli::demoPage({}), HasSubstr("</html>"));
}

TEST(DemoTable, HasARowForEachTechnique) {
  const auto table = cli::demoTable(report());
  EXPECT_THAT(table, HasSubstr("street"));
  EXPECT_THAT(table, HasSubstr("pinhole"));
  EXPECT_THAT(table, HasSubstr("equal"));
}

TEST(ErrorMap, IsBlackWhereEqualAndBrightensWithTheError) {
  float last = -1.0f;
  for (int i = 0; i <= 20; ++i) {
    const auto color = cli::errorColor(cli::kErrorMapEnd * static_cast<float>(i) / 20.0f);
    const float luma = 0.2126f * color[0] + 0.7152f * color[1] + 0.0722f * color[2];
    EXPECT_GT(luma, last) << i;
    last = luma;
  }
  EXPECT_EQ(cli::errorColor(1.0f), cli::errorColor(cli::kErrorMapEnd));
}

TEST(ErrorMap, ShowsTheDifferingPixelAlone) {
  engine::FloatImage reference(3, 1, 3, 0.5f), picture = reference;
  picture.pixel(1, 0)[2] = 0.0f;
  const auto map = cli::errorMap(picture, reference);
  EXPECT_LT(map.pixel(0, 0)[0], 0.01f);
  EXPECT_GT(map.pixel(1, 0)[0], 0.5f);
  EXPECT_LT(map.pixel(2, 0)[0], 0.01f);
}

}  // namespace

}  // namespace lensgraph
