// Measuring frames and looking into them: see looks.h.
#include "samples/lensgraph/capture/image_dumps.h"

#include <charconv>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <sstream>

#include "engine/error.h"
#include "engine/image/image_io.h"
#include "rendergraph/trace.h"
#include "samples/lensgraph/session.h"

namespace lensgraph::cli {
namespace {

/// How many names an error line lists; the others are found with --dump-image list.
constexpr std::size_t kNamesInError = 24;

[[noreturn]] void failDump(const std::string& reason, const std::string& remedy) {
  throw engine::Error({.file = "command line", .field = "--dump-image", .reason = reason, .remedy = remedy});
}

bool readNumbers(std::string_view text, uint32_t& mip, uint32_t& layer) {
  const char* end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, mip);
  if (first.ec != std::errc{} || first.ptr == end || *first.ptr != ',') return false;
  const auto second = std::from_chars(first.ptr + 1, end, layer);
  return second.ec == std::errc{} && second.ptr == end;
}

std::string nameOf(const rendergraph::TapChoice& choice) {
  return choice.pass + "/" + choice.resource;
}

rendergraph::Timing timingOf(const LookArguments& arguments, const engine::DeviceDescription& device) {
  // Timestamps of single passes are wrong on lavapipe once something is drawn.
  const bool isolated = arguments.timing ? *arguments.timing == "isolated" : device.type == "cpu";
  return isolated ? rendergraph::Timing::isolated : rendergraph::Timing::inlineTimestamps;
}

}  // namespace

ImageDump::ImageDump(const std::string& argument) {
  constexpr const char* kRemedy = "write PASS/RESOURCE=FILE.exr, PASS/RESOURCE[MIP,LAYER]=FILE.exr, or list";
  const auto equals = argument.find('=');
  const auto slash = argument.find('/');
  if (equals == std::string::npos || slash == std::string::npos || slash > equals) {
    failDump("\"" + argument + "\" names no image and file", kRemedy);
  }
  image = argument.substr(0, equals);
  file = argument.substr(equals + 1);
  tap.pass = image.substr(0, slash);
  tap.resource = image.substr(slash + 1);
  const auto bracket = tap.resource.find('[');
  if (bracket != std::string::npos) {
    const std::string_view inside = std::string_view(tap.resource).substr(bracket + 1);
    if (!inside.ends_with(']') || !readNumbers(inside.substr(0, inside.size() - 1), tap.mip, tap.layer)) {
      failDump("\"" + image.substr(image.find('[')) + "\" is no mip and layer", "write [MIP,LAYER], such as [0,0]");
    }
    tap.resource.resize(bracket);
  }
  if (tap.pass.empty() || tap.resource.empty()) failDump("\"" + image + "\" names no image", kRemedy);
}

Looks::Looks(const LookArguments& arguments) : arguments_(arguments) {
  lists_ = arguments.dumps == std::vector<std::string>{"list"};
  if (!lists_) {
    for (const auto& dump : arguments.dumps) dumps_.emplace_back(dump);
  }
  for (const auto& dump : dumps_) checkOutput(dump.file, "--dump-image", kDumpExtensions);
  if (arguments.capture) checkOutput(*arguments.capture, "--capture");
  if (arguments.trace) checkOutput(*arguments.trace, "--trace");
  if (arguments.capture || arguments.trace) return;
  const char* idle = arguments.frames ? "--capture-frames" : arguments.timing ? "--timing" : nullptr;
  if (idle == nullptr) return;
  throw engine::Error({.file = "command line",
                       .field = idle,
                       .reason = "nothing is measured",
                       .remedy = "give --capture FILE.json or --trace FILE.json too"});
}

std::vector<OutputFile> Looks::outputs() const {
  std::vector<OutputFile> files;
  if (arguments_.capture) files.push_back({*arguments_.capture, "--capture"});
  if (arguments_.trace) files.push_back({*arguments_.trace, "--trace"});
  for (const auto& dump : dumps_) files.push_back({dump.file, "--dump-image"});
  return files;
}

host::Rendering Looks::measure(host::RenderOptions options, const RenderOnce& renderOnce) {
  const bool isolated = options.execute.timing == rendergraph::Timing::isolated;
  host::RenderOptions inOnePiece = options;
  inOnePiece.execute.timing = rendergraph::Timing::inlineTimestamps;
  renderOnce(options);
  measurement_.emplace();
  if (arguments_.trace) {
    options.observe = [this](const auto& capture) { measurement_->executions.push_back(capture); };
  }
  const int frames = arguments_.frames.value_or(LookArguments::kDefaultFrames);
  host::Rendering rendering;
  for (int frame = 0; frame < frames; ++frame) {
    if (isolated) measurement_->uninterruptedMs.push_back(renderOnce(inOnePiece).gpuMs);
    rendering = renderOnce(options);
    measurement_->gpuMs.push_back(rendering.gpuMs);
    measurement_->wallMs.push_back(rendering.wallMs);
    if (!measurement_->series.add(rendering.capture)) {
      throw engine::Error("the measured frames differ in their passes", engine::ErrorKind::failed);
    }
  }
  return rendering;
}

host::Rendering Looks::render(const engine::DeviceDescription& device, host::RenderOptions options,
                              const RenderOnce& renderOnce) {
  const bool measures = arguments_.capture || arguments_.trace;
  const bool taps = lists_ || !dumps_.empty();
  host::Rendering rendering;
  if (measures) {
    options.execute.timing = timingOf(arguments_, device);
    rendering = measure(options, renderOnce);
    if (!taps) return rendering;
  }
  options.execute.timing = rendergraph::Timing::inlineTimestamps;
  if (taps) options.tapped = &tapped_;
  for (const auto& dump : dumps_) options.taps.push_back(dump.tap);
  host::Rendering tapped = renderOnce(options);
  requireMatches();
  return measures ? std::move(rendering) : std::move(tapped);
}

void Looks::printList() const {
  std::size_t width = 0;
  for (const auto& choice : tapped_.choices) width = std::max(width, nameOf(choice).size());
  for (const auto& choice : tapped_.choices) {
    std::printf("%-*s  %u x %u px, mips %u, layers %u\n", static_cast<int>(width), nameOf(choice).c_str(), choice.width,
                choice.height, choice.mips, choice.layers);
  }
}

void Looks::requireMatches() const {
  for (std::size_t i = 0; i < dumps_.size(); ++i) {
    if (!tapped_.pictures[i].isEmpty()) continue;
    std::vector<std::string> names;
    for (const auto& choice : tapped_.choices) names.push_back(nameOf(choice));
    const std::vector<std::string_view> views(names.begin(), names.end());
    const std::string plain = dumps_[i].tap.pass + "/" + dumps_[i].tap.resource;
    const auto nearest = passes::nearestName(plain, views);
    std::string remedy;
    if (!nearest.empty() && nearest != plain) remedy = "did you mean " + std::string(nearest) + "? ";
    remedy += "there are ";
    for (std::size_t name = 0; name < std::min(names.size(), kNamesInError); ++name) {
      remedy += (name > 0 ? ", " : "") + names[name];
    }
    if (names.size() > kNamesInError) remedy += ", …: see --dump-image list";
    const bool outside = nearest == plain;
    failDump(dumps_[i].image + (outside ? " has no such mip and layer" : " matches no image of the graph"), remedy);
  }
}

void Looks::write(const engine::DeviceDescription& device, const CaptureInput& input,
                  const host::TechniqueChoice& choice, const host::Rendering& rendering) const {
  if (arguments_.capture) {
    writeTextFile(*arguments_.capture, captureJson(device, input, choice, rendering, *measurement_).dump(2) + "\n");
  }
  if (arguments_.trace) {
    std::ostringstream text;
    rendergraph::writeTrace(text, measurement_->executions, "lensgraph " + choice.name + " on " + describe(device));
    writeTextFile(*arguments_.trace, text.str());
  }
  for (std::size_t i = 0; i < dumps_.size(); ++i) engine::writeImage(dumps_[i].file, tapped_.pictures[i]);
}

}  // namespace lensgraph::cli
