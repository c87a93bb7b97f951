// What to tell somebody whose picture is larger than the device allows: which size would fit.
#pragma once

#include <functional>
#include <optional>

#include "engine/error.h"
#include "rendergraph/error.h"

namespace lensgraph::host {

struct PictureExtent {
  int width = 0, height = 0;  ///< px
};

/// The largest picture of the wanted one's shape that fits, by halving the interval of heights; none when not even the
/// smallest does. Precondition: `wanted` itself does not fit. `fits` is asked about 14 times.
std::optional<PictureExtent> largestFitting(PictureExtent wanted, const std::function<bool(PictureExtent)>& fits);

/// The error for a graph that is over a limit of the device (bad input): size, technique, reason, and the size that fits.
engine::Error tooLarge(PictureExtent wanted, const std::string& technique, const rendergraph::GraphError& problem,
                       const std::optional<PictureExtent>& fitting);

}  // namespace lensgraph::host
