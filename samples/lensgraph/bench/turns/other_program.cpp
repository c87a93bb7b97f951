// Turns of another build, as processes of its own: see other_program.h.
#include "samples/lensgraph/bench/turns/other_program.h"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <vector>

#include "engine/error.h"
#include "samples/lensgraph/bench/turns/child_process.h"

namespace lensgraph::cli {
namespace {

using nlohmann::json;
using std::filesystem::path;

[[noreturn]] void failProgram(const std::string& text, const std::string& reason) {
  throw engine::Error({.file = "command line",
                       .field = "--program " + text,
                       .reason = reason,
                       .remedy = "write NAME=PATH with the path of another build's lensgraph"});
}

std::string lastLine(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text.substr(text.rfind('\n') + 1);
}

std::vector<std::string> argumentsOf(const RenderRequest& request) {
  std::vector<std::string> arguments = {
      "render",      request.shot.string(),
      "--size",      std::to_string(request.width) + "x" + std::to_string(request.height),
      "--technique", request.choice.name,
      "-o",          request.picture.string()};
  for (const auto& [name, value] : request.choice.parameters) {
    arguments.insert(arguments.end(), {"--set", name + "=" + passes::toString(value)});
  }
  if (!request.device.empty()) arguments.insert(arguments.end(), {"--device", request.device});
  return arguments;
}

double medianOf(const json& document, const char* name) {
  if (!document.contains(name) || !document[name].is_object()) return 0.0;
  const auto& spread = document[name];
  return spread.contains("median") && spread["median"].is_number() ? spread["median"].get<double>() : 0.0;
}

}  // namespace

OtherProgram::OtherProgram(const std::string& nameAndPath) {
  const auto equals = nameAndPath.find('=');
  if (equals == std::string::npos || equals == 0) failProgram(nameAndPath, "is no NAME=PATH");
  name_ = nameAndPath.substr(0, equals);
  path_ = nameAndPath.substr(equals + 1);
  if (name_ == "this") failProgram(nameAndPath, "\"this\" is the program that runs the benchmark");
  const auto version = runChild(path_, {"--version"});
  const std::string line = lastLine(version.out);
  if (version.status != 0 || !line.starts_with("lensgraph ")) {
    failProgram(nameAndPath, version.err.empty() ? "is no lensgraph" : "cannot be run: " + lastLine(version.err));
  }
  const auto bracket = line.find(" (");
  version_ = line.substr(0, bracket);
  if (bracket != std::string::npos) commit_ = line.substr(bracket + 2, line.size() - bracket - 3);
  timesFrames_ = runChild(path_, {"render", "--help"}).out.find("--frames-timed") != std::string::npos;
}

bool OtherProgram::render(const RenderRequest& request, std::string& reason) const {
  const auto outcome = runChild(path_, argumentsOf(request));
  if (outcome.status != 0) reason = lastLine(outcome.err);
  return outcome.status == 0;
}

std::optional<TurnTimes> OtherProgram::measure(const RenderRequest& request, const path& scratch,
                                               std::string& reason) const {
  const auto times = timesFrames_ ? timedFrames(request, reason) : framesByDifference(request, scratch, reason);
  if (times && times->cpuMs > 0.0) return times;
  if (times) reason = "it tells no time of a frame";
  return {};
}

std::optional<TurnTimes> OtherProgram::timedFrames(const RenderRequest& request, std::string& reason) const {
  constexpr int kFrames = 3;
  auto arguments = argumentsOf(request);
  arguments.insert(arguments.end(), {"--json", "--frames-timed", std::to_string(kFrames)});
  const auto outcome = runChild(path_, arguments);
  const auto report = json::parse(outcome.out, nullptr, false);
  if (outcome.status != 0 || !report.is_object() || !report.contains("warm") || !report["warm"].is_object()) {
    reason = lastLine(outcome.err);
    return {};
  }
  const auto& warm = report["warm"];
  return TurnTimes{medianOf(warm, "cpuMs"), medianOf(warm, "wallMs"), medianOf(warm, "gpuMs")};
}

std::optional<TurnTimes> OtherProgram::framesByDifference(const RenderRequest& request, const path& scratch,
                                                          std::string& reason) const {
  const path capture = scratch / "capture.json";
  const auto run = [&](int frames) {
    auto arguments = argumentsOf(request);
    arguments.insert(arguments.end(),
                     {"--capture", capture.string(), "--capture-frames", std::to_string(frames), "--timing", "inline"});
    return runChild(path_, arguments);
  };
  const auto few = run(1);
  std::ifstream stream(capture);
  const auto document = json::parse(stream, nullptr, false);
  stream.close();
  if (few.status != 0 || !document.is_object()) {
    reason = lastLine(few.err);
    return {};
  }
  TurnTimes times{.cpuMs = 0.0, .wallMs = medianOf(document, "wallMs"), .gpuMs = medianOf(document, "gpuMs")};
  // Enough frames that the difference is far above what starting up varies by, which is some tenths of a second.
  constexpr double kLongEnoughMs = 3000.0;
  constexpr int kMostFrames = 40;
  const int more = static_cast<int>(std::clamp(kLongEnoughMs / std::max(times.wallMs, 1.0), 2.0, double{kMostFrames}));
  const auto many = run(1 + more);
  if (many.status != 0) {
    reason = lastLine(many.err);
    return {};
  }
  times.cpuMs = std::max(many.cpuMs - few.cpuMs, 0.0) / more;
  return times;
}

}  // namespace lensgraph::cli
