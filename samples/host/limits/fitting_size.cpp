// The search for a size that fits: see fitting_size.h.
#include "samples/host/limits/fitting_size.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace lensgraph::host {
namespace {

std::string text(PictureExtent extent) {
  return std::to_string(extent.width) + "x" + std::to_string(extent.height);
}

}  // namespace

std::optional<PictureExtent> largestFitting(PictureExtent wanted, const std::function<bool(PictureExtent)>& fits) {
  const auto ofHeight = [&](int height) {
    const double width = std::round(static_cast<double>(wanted.width) * height / wanted.height);
    return PictureExtent{std::max(1, static_cast<int>(width)), height};
  };
  int fitting = 0, tooHigh = wanted.height;
  while (tooHigh - fitting > 1) {
    const int middle = fitting + (tooHigh - fitting) / 2;
    (fits(ofHeight(middle)) ? fitting : tooHigh) = middle;
  }
  if (fitting == 0) return std::nullopt;
  return ofHeight(fitting);
}

engine::Error tooLarge(PictureExtent wanted, const std::string& technique, const rendergraph::GraphError& problem,
                       const std::optional<PictureExtent>& fitting) {
  const auto& first = problem.problems().front();
  return engine::Error({.file = {},
                        .field = {},
                        .reason = text(wanted) + " px is more than this device takes for " + technique + " (" +
                                  first.resource + ": " + first.reason + ")",
                        .remedy = fitting ? "up to " + text(*fitting) + " px fits" : "no size fits this scene"});
}

}  // namespace lensgraph::host
