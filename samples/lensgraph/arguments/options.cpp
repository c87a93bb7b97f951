// Options that several subcommands share: see options.h.
#include "samples/lensgraph/arguments/options.h"

#include <charconv>
#include <cmath>
#include <vector>

#include "engine/error.h"
#include "samples/host/shot.h"

namespace lensgraph::cli {
namespace {

PictureSize parseSize(const std::string& text) {
  const char* end = text.data() + text.size();
  PictureSize size;
  const auto width = std::from_chars(text.data(), end, size.width);
  const bool hasX = width.ec == std::errc{} && width.ptr != end && (*width.ptr == 'x' || *width.ptr == 'X');
  const auto height = hasX ? std::from_chars(width.ptr + 1, end, size.height) : width;
  if (!hasX || height.ec != std::errc{} || height.ptr != end) {
    failUsage("--size", "\"" + text + "\" is no size", "write WIDTHxHEIGHT, such as 640x360");
  }
  const auto fits = [](int pixels) { return pixels >= 1 && pixels <= host::kMaxResolution; };
  if (!fits(size.width) || !fits(size.height)) {
    failUsage("--size", "is " + text + ", each side must be from 1 to " + std::to_string(host::kMaxResolution) + " px",
              "");
  }
  return size;
}

}  // namespace

[[noreturn]] void failUsage(const std::string& field, const std::string& reason, const std::string& remedy) {
  throw engine::Error({.file = "command line", .field = field, .reason = reason, .remedy = remedy});
}

void requireFinite(const std::string& field, double value) {
  if (!std::isfinite(value)) failUsage(field, "is not a finite number", "");
}

void addSize(CLI::App& app, std::optional<PictureSize>& size) {
  app.add_option_function<std::string>(
         "--size", [&size](const std::string& text) { size = parseSize(text); },
         "Picture size in pixels instead of the shot's")
      ->type_name("WxH");
}

void addFaces(CLI::App& app, std::optional<engine::DrawnFaces>& faces) {
  app.add_option_function<std::string>(
         "--faces",
         [&faces](const std::string& text) {
           faces = host::drawnFacesFrom(text);
           if (!faces) failUsage("--faces", "\"" + text + "\" is neither material nor both", "");
         },
         "Faces to draw instead of the shot's choice: material leaves out the back faces of single-sided materials")
      ->type_name("material|both");
}

void addExposure(CLI::App& app, std::optional<double>& exposure) {
  app.add_option_function<double>(
         "--exposure",
         [&exposure](double value) {
           requireFinite("--exposure", value);
           exposure = value;
         },
         "Brighten PNG output by this many stops before it is clamped and sRGB-encoded")
      ->type_name("EV");
}

void addTechnique(CLI::App& app, TechniqueArguments& technique, bool required) {
  app.add_option("--technique", technique.technique, "Technique to use (see lensgraph techniques)")
      ->type_name("NAME")
      ->required(required);
  app.add_option("--set", technique.settings, "Set one parameter of the technique; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  app.add_option("--config", technique.config, "File {\"technique\": {\"name\": …, parameters…}}")
      ->type_name("FILE.json");
}

void addInspection(CLI::App& app, InspectionArguments& inspection) {
  app.add_option("--capture", inspection.capture,
                 "Write times, memory, device, parameters (see capture-view, capture-diff)")
      ->type_name("FILE.json");
  app.add_option("--trace", inspection.trace, "Write a timeline that Perfetto opens")->type_name("FILE.json");
  app.add_option("--capture-frames", inspection.frames, "Frames to measure after a first one that is not (default 5)")
      ->type_name("N")
      ->check(CLI::Range(1, 1000));
  app.add_option("--timing", inspection.timing,
                 "inline: timestamps in the frame; isolated: each pass by itself, right on every device. Default: "
                 "isolated on CPU devices, inline on others")
      ->type_name("MODE")
      ->check(CLI::IsMember({"inline", "isolated"}));
  app.add_option("--frames-timed", inspection.framesTimed,
                 "Time this many more whole frames after the picture, when all is warm (default: 1 with --json)")
      ->type_name("N")
      ->check(CLI::Range(0, 100000));
  app.add_flag("--json", inspection.json, "Print the report as JSON");
  app.add_option("--dump-image", inspection.dumps,
                 "Write an image inside the graph, as it is after the pass; may be repeated. list: say which there are")
      ->type_name("PASS/RESOURCE[MIP,LAYER]=FILE.exr|png")
      ->allow_extra_args(false);
}

void requireOutput(const std::string& subcommand, const std::filesystem::path& output,
                   const InspectionArguments& inspection) {
  if (output.empty() && inspection.dumps != std::vector<std::string>{"list"}) {
    failUsage(subcommand, "--output is required", "see lensgraph " + subcommand + " --help");
  }
}

}  // namespace lensgraph::cli
