// Who used the memory of a resource before it: the resources whose last uses its first use must wait for. Pure.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rendergraph/plan.h"

namespace rendergraph {

/// By resource: those whose bytes it takes over. Only the latest occupants of each byte are named, since these have
/// waited for the ones before; but an occupant that left a part of its memory untouched (`fullyUsed` false) has not
/// waited everywhere, so those before it are named too.
std::vector<std::vector<uint32_t>> previousOccupants(std::span<const Placement> placements, std::size_t resources,
                                                     std::span<const uint8_t> fullyUsed);

}  // namespace rendergraph
