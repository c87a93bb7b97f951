// The rules of plan.h that need no replay, and those of Vulkan's commands: what may stand where.
#pragma once

#include <vector>

#include "plan_checker/plan_checker.h"

namespace lensgraph::plan_checker {

/// Steps, submissions, queues, barriers, events and renderings. Empty: the plan can be replayed.
std::vector<Finding> checkStructure(const Setting& setting);

/// Heaps, placements, lifetimes and the memory report.
std::vector<Finding> checkMemory(const Setting& setting);

}  // namespace lensgraph::plan_checker
