// What the tests of pages have in common: a browser, a folder for the page, and checks that hold for every page.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "browser.h"
#include "tests/support/temporary_folder.h"

namespace lensgraph::page_test {

/// Skips where Chromium is not installed; fails there when the environment's LENSGRAPH_ALL_TESTS is "required". After
/// each test the page must have raised no complaint.
class PageTest : public testing::Test {
 protected:
  void SetUp() override;
  void TearDown() override;

  Browser& browser() { return *browser_; }
  const test::TemporaryFolder& folder() const { return folder_; }

  /// Writes the page into the folder and opens it.
  void open(std::string_view page, const Window& window = {});
  /// The page is no wider than its window, whatever the window's width down to 360 px.
  void expectFitsNarrowWindows();
  /// The theme's button switches text and background, away from what the system prefers and back.
  void expectSwitchesBetweenLightAndDark();
  /// Text and background are others where the system prefers dark colors, and the text can be read on both.
  void expectFollowsTheSystemsColors();

 private:
  test::TemporaryFolder folder_;
  static std::optional<Browser> browser_;  ///< One for all tests of the process: a start takes longer than a test.
  /// The CSS colors of the page's text and background, and the contrast between them as WCAG 2 defines it.
  nlohmann::json colors();

  std::filesystem::path file_;
};

}  // namespace lensgraph::page_test
