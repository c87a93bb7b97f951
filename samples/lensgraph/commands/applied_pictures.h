// The pictures that `lensgraph apply` works on: read, converted, checked, and described.
#pragma once

#include <string>
#include <vector>

#include "engine/image/image.h"
#include "samples/lensgraph/subcommands.h"

namespace lensgraph::cli {

struct AppliedPictures {
  engine::FloatImage color;          ///< RGBA, finite.
  engine::FloatImage depth;          ///< z in metres, infinite where there is none.
  std::vector<std::string> summary;  ///< Lines for stdout: what was read, and what depth was taken for.
};

/// Throws engine::Error (bad input), naming the option, when they contradict each other or a number is out of range.
void checkDepthArguments(const DepthArguments& arguments);

/// Reads both pictures. Warns of pixels that had to be replaced, and of depth that does not fit the focus distance. Throws
/// engine::Error: see engine::readImage() and readDepth(); depth of another size, without any positive value, or of
/// integers without a scale.
AppliedPictures readAppliedPictures(const ApplyArguments& arguments);

}  // namespace lensgraph::cli
