// A headless Chromium with one page, driven as a user would: real clicks, keys and drags, through the DevTools protocol
// (https://chromedevtools.github.io/devtools-protocol) on pipes.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "pipe_process.h"
#include "tests/support/temporary_folder.h"

namespace lensgraph::page_test {

struct Window {
  int width = 1280, height = 900;  ///< px
  bool prefersDark = false;        ///< What the page finds in prefers-color-scheme.
};

/// A point of an element: shares of its width and height, from its upper left corner.
struct Place {
  double x = 0.5, y = 0.5;
};

/// Every function throws std::runtime_error when the browser does not answer within half a minute.
class Browser {
 public:
  /// Where Chromium is installed; none where it is not.
  static std::optional<std::filesystem::path> program();

  /// Precondition: program() has a value.
  Browser();

  /// Opens the file and waits until it is loaded.
  void open(const std::filesystem::path& file, const Window& window = {});

  /// The value of a JavaScript expression, awaited when it is a promise. Throws when it throws.
  nlohmann::json evaluate(const std::string& expression);
  /// Whether the expression becomes true within ten seconds.
  bool becomesTrue(const std::string& expression);
  /// Text of the first element of that CSS selector.
  std::string text(const std::string& selector);

  /// Scrolls the first element of the selector into view and clicks it. Throws when there is none, when it has no size,
  /// or when something else lies over it.
  void click(const std::string& selector, Place place = {});
  void hover(const std::string& selector, Place place = {});
  void drag(const std::string& selector, Place from, Place to);
  /// Presses a key by its DOM name, such as "Enter", "ArrowRight" or "d", where the focus is.
  void press(const std::string& key);
  /// Chooses the option of that value in a <select>, as a change by the user.
  void choose(const std::string& selector, const std::string& value);

  /// What went wrong since the page was opened: errors and warnings of the console, exceptions, and requests for anything
  /// but data URIs and files.
  const std::vector<std::string>& complaints();

 private:
  nlohmann::json send(const std::string& method, const nlohmann::json& parameters = nlohmann::json::object());
  nlohmann::json receive();
  void note(const nlohmann::json& event);
  void mouse(const std::string& type, double x, double y, bool isPressed);
  struct Point {
    double x, y;
  };
  Point pointIn(const std::string& selector, Place place);

  test::TemporaryFolder profile_;
  PipeProcess process_;
  int lastId_ = 0;
  std::string session_;
  bool isLoaded_ = false;
  std::vector<std::string> complaints_;
};

}  // namespace lensgraph::page_test
