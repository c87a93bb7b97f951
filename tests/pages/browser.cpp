// The DevTools protocol, as far as the tests of pages need it: see browser.h.
#include "browser.h"

#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace lensgraph::page_test {
namespace {

using nlohmann::json;
using std::filesystem::path;
using Clock = std::chrono::steady_clock;

std::vector<std::string> argumentsOf(const path& profile) {
  return {Browser::program()->string(), "--headless=new", "--remote-debugging-pipe",
          // In a container, tests run as root, without a GPU, and with little shared memory.
          "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
          // Nothing is asked of any network.
          "--host-resolver-rules=MAP * ~NOTFOUND", "--disable-background-networking", "--disable-component-update",
          "--disable-sync", "--disable-extensions", "--disable-breakpad", "--no-first-run", "--hide-scrollbars",
          "--force-device-scale-factor=1", "--user-data-dir=" + profile.string()};
}

/// The text as a JavaScript string.
std::string quoted(const std::string& text) {
  return json(text).dump();
}

}  // namespace

std::optional<path> Browser::program() {
  const char* folders = std::getenv("PATH");
  std::istringstream stream(folders == nullptr ? "" : folders);
  for (std::string folder; std::getline(stream, folder, ':');) {
    const path candidate = path(folder) / "chromium";
    if (access(candidate.c_str(), X_OK) == 0) return candidate;
  }
  return std::nullopt;
}

Browser::Browser() : process_(argumentsOf(profile_.path())) {
  const auto target = send("Target.createTarget", {{"url", "about:blank"}}).at("targetId");
  session_ = send("Target.attachToTarget", {{"targetId", target}, {"flatten", true}}).at("sessionId");
  for (const char* domain : {"Page", "Runtime", "Log", "Network"}) send(std::string(domain) + ".enable");
}

void Browser::open(const path& file, const Window& window) {
  send("Emulation.setDeviceMetricsOverride",
       {{"width", window.width}, {"height", window.height}, {"deviceScaleFactor", 1}, {"mobile", false}});
  const json scheme = {{"name", "prefers-color-scheme"}, {"value", window.prefersDark ? "dark" : "light"}};
  send("Emulation.setEmulatedMedia", {{"features", json::array({scheme})}});
  complaints_.clear();
  isLoaded_ = false;
  send("Page.navigate", {{"url", "file://" + file.string()}});
  while (!isLoaded_) receive();
}

json Browser::evaluate(const std::string& expression) {
  const json answer =
      send("Runtime.evaluate", {{"expression", expression}, {"awaitPromise", true}, {"returnByValue", true}});
  if (answer.contains("exceptionDetails")) {
    throw std::runtime_error(expression + ": " + answer.at("exceptionDetails").dump());
  }
  return answer.at("result").value("value", json());
}

bool Browser::becomesTrue(const std::string& expression) {
  const auto deadline = Clock::now() + std::chrono::seconds(10);
  while (evaluate(expression) != json(true)) {
    if (Clock::now() > deadline) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return true;
}

std::string Browser::text(const std::string& selector) {
  return evaluate("document.querySelector(" + quoted(selector) + ").innerText").get<std::string>();
}

Browser::Point Browser::pointIn(const std::string& selector, Place place) {
  const json at = evaluate("(() => { const element = document.querySelector(" + quoted(selector) +
                           "); if (!element) return 'there is none';"
                           "element.scrollIntoView({ block: 'center', inline: 'center', behavior: 'instant' });"
                           "const box = element.getBoundingClientRect();"
                           "if (!box.width || !box.height) return 'it has no size';"
                           "const x = box.left + " +
                           std::to_string(place.x) + " * box.width, y = box.top + " + std::to_string(place.y) +
                           " * box.height;"
                           "const hit = document.elementFromPoint(x, y);"
                           "if (!hit || !(element.contains(hit) || hit.contains(element)))"
                           "  return 'it is covered by ' + (hit ? hit.outerHTML.slice(0, 200) : 'nothing');"
                           "return { x, y }; })()");
  if (at.is_string()) throw std::runtime_error(selector + ": " + at.get<std::string>());
  return {at.at("x"), at.at("y")};
}

void Browser::mouse(const std::string& type, double x, double y, bool isPressed) {
  send("Input.dispatchMouseEvent", {{"type", type},
                                    {"x", x},
                                    {"y", y},
                                    {"button", isPressed ? "left" : "none"},
                                    {"buttons", isPressed && type != "mouseReleased" ? 1 : 0},
                                    {"clickCount", type == "mouseMoved" ? 0 : 1}});
}

void Browser::click(const std::string& selector, Place place) {
  drag(selector, place, place);
}

void Browser::hover(const std::string& selector, Place place) {
  const Point at = pointIn(selector, place);
  mouse("mouseMoved", at.x, at.y, false);
}

void Browser::drag(const std::string& selector, Place from, Place to) {
  const Point begin = pointIn(selector, from), end = pointIn(selector, to);
  mouse("mouseMoved", begin.x, begin.y, false);
  mouse("mousePressed", begin.x, begin.y, true);
  if (begin.x != end.x || begin.y != end.y) mouse("mouseMoved", end.x, end.y, true);
  mouse("mouseReleased", end.x, end.y, true);
}

void Browser::press(const std::string& key) {
  json parameters = {{"type", "keyDown"}, {"key", key}};
  // Keys of one letter give text; so does Enter, which presses buttons by it.
  if (key.size() == 1) parameters["text"] = key;
  if (key == "Enter") parameters["text"] = "\r";
  send("Input.dispatchKeyEvent", parameters);
  send("Input.dispatchKeyEvent", {{"type", "keyUp"}, {"key", key}});
}

void Browser::choose(const std::string& selector, const std::string& value) {
  const json chosen = evaluate(
      "(() => { const select = document.querySelector(" + quoted(selector) + "); select.value = " + quoted(value) +
      "; select.dispatchEvent(new Event('change', { bubbles: true })); return select.value; })()");
  if (chosen != json(value)) throw std::runtime_error(selector + ": has no option " + value);
}

const std::vector<std::string>& Browser::complaints() {
  evaluate("0");  // Events before it have arrived then.
  return complaints_;
}

json Browser::send(const std::string& method, const json& parameters) {
  json message = {{"id", ++lastId_}, {"method", method}, {"params", parameters}};
  if (!session_.empty()) message["sessionId"] = session_;
  process_.write(message.dump());
  for (;;) {
    const json answer = receive();
    if (answer.value("id", 0) != lastId_) continue;
    if (answer.contains("error")) throw std::runtime_error(method + ": " + answer.at("error").dump());
    return answer.at("result");
  }
}

json Browser::receive() {
  const json message = json::parse(process_.read(Clock::now() + std::chrono::seconds(30)));
  if (message.contains("method")) note(message);
  return message;
}

void Browser::note(const json& event) {
  const std::string method = event.at("method");
  const json& parameters = event.at("params");
  if (method == "Page.loadEventFired") {
    isLoaded_ = true;
  } else if (method == "Runtime.exceptionThrown") {
    complaints_.push_back("exception: " + parameters.at("exceptionDetails").dump());
  } else if (method == "Runtime.consoleAPICalled") {
    const std::string type = parameters.at("type");
    if (type == "error" || type == "warning" || type == "assert") {
      complaints_.push_back("console: " + parameters.at("args").dump());
    }
  } else if (method == "Log.entryAdded") {
    const json& entry = parameters.at("entry");
    if (entry.at("level") == "error" || entry.at("level") == "warning") complaints_.push_back("log: " + entry.dump());
  } else if (method == "Network.requestWillBeSent") {
    const std::string url = parameters.at("request").at("url");
    if (!url.starts_with("data:") && !url.starts_with("file://")) complaints_.push_back("request: " + url);
  }
}

}  // namespace lensgraph::page_test
