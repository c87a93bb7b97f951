// The browser of these tests reports what is wrong with a page; otherwise no test of a page could fail.
#include "browser.h"

#include <fstream>

#include "page_test.h"

namespace lensgraph::page_test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

class BrowserTest : public PageTest {
 protected:
  /// Complaints about a page with that body. It is not the fixture's page, which must have none.
  std::vector<std::string> complaintsAbout(const std::string& body) {
    const auto file = folder() / "broken.html";
    std::ofstream(file) << "<!doctype html><meta charset=utf-8><title>t</title><body>" << body;
    browser().open(file);
    return browser().complaints();
  }
};

TEST_F(BrowserTest, ReportsErrorsWarningsExceptionsAndRequests) {
  EXPECT_THAT(complaintsAbout("<p>well</p><script>console.log('a word')</script>"), IsEmpty());
  EXPECT_THAT(complaintsAbout("<script>console.error('one')</script>"), Contains(HasSubstr("one")));
  EXPECT_THAT(complaintsAbout("<script>console.warn('two')</script>"), Contains(HasSubstr("two")));
  EXPECT_THAT(complaintsAbout("<script>absent()</script>"), Contains(HasSubstr("absent is not defined")));
  EXPECT_THAT(complaintsAbout("<img src='https://example.org/a.png'>"), Contains("request: https://example.org/a.png"));
  EXPECT_THAT(complaintsAbout("<img src='absent.png'>"), Contains(HasSubstr("absent.png")));
}

TEST_F(BrowserTest, ClicksOnlyWhatAUserCouldClick) {
  complaintsAbout(
      "<button id=a onclick='this.value=1'>a</button><button id=b hidden>b</button>"
      "<button id=d style='position:absolute;top:90px'>d</button>"
      "<div style='position:fixed;inset:40px 0 0 0;background:red'></div>");
  browser().click("#a");
  EXPECT_EQ(browser().evaluate("a.value"), "1");
  EXPECT_THROW(browser().click("#b"), std::runtime_error);
  EXPECT_THROW(browser().click("#d"), std::runtime_error);
  EXPECT_THROW(browser().click("#absent"), std::runtime_error);
}

}  // namespace
}  // namespace lensgraph::page_test
