// Reads the arguments of --dump-image, and matches them with the images that the graph has.
#include "samples/lensgraph/capture/image_dumps.h"

#include <algorithm>
#include <charconv>
#include <cstdio>

#include "engine/error.h"
#include "engine/image/image_io.h"

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

ImageDumps::ImageDumps(const std::vector<std::string>& arguments)
    : lists_(arguments == std::vector<std::string>{"list"}) {
  if (lists_) return;
  for (const std::string& argument : arguments) dumps_.emplace_back(argument);
  for (const ImageDump& dump : dumps_) checkOutput(dump.file, "--dump-image", kDumpExtensions);
}

void ImageDumps::appendOutputs(std::vector<OutputFile>& files) const {
  for (const ImageDump& dump : dumps_) files.push_back({dump.file, "--dump-image"});
}

void ImageDumps::addTo(host::RenderOptions& options) {
  options.tapped = &tapped_;
  for (const ImageDump& dump : dumps_) options.taps.push_back(dump.tap);
}

void ImageDumps::printList() const {
  std::size_t width = 0;
  for (const auto& choice : tapped_.choices) width = std::max(width, nameOf(choice).size());
  for (const auto& choice : tapped_.choices) {
    std::printf("%-*s  %u x %u px, mips %u, layers %u\n", static_cast<int>(width), nameOf(choice).c_str(), choice.width,
                choice.height, choice.mips, choice.layers);
  }
}

void ImageDumps::requireMatches() const {
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

void ImageDumps::write() const {
  for (std::size_t i = 0; i < dumps_.size(); ++i) engine::writeImage(dumps_[i].file, tapped_.pictures[i]);
}

}  // namespace lensgraph::cli
