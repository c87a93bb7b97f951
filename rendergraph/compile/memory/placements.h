// Lives of the graph's own resources, and their places in memory. Pure.
#pragma once

#include <span>

#include "rendergraph/compile/flow/resource_needs.h"
#include "rendergraph/compile/schedule/queues.h"
#include "rendergraph/compile_options.h"
#include "rendergraph/device_facts.h"
#include "rendergraph/plan.h"

namespace lensgraph::rendergraph {

struct Schedule;
struct Submissions;

/// Fills Plan::placements, heaps, persistent and memory. `sharing` is empty on one queue.
void placeResources(const Declaration& declaration, std::span<const ResourceNeed> uses,
                    std::span<const Sharing> sharing, const Schedule& schedule, const Submissions& submissions,
                    Aliasing aliasing, Plan& plan);

}  // namespace lensgraph::rendergraph
