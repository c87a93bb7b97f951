// An independent judge of plans: its own model of Vulkan's memory dependencies, its own table of what each usage
// touches, sharing no code with the planner.
//
// The model. Every use of a subresource leaves one record per pipeline stage. A record knows the stages that are
// ordered after it, whether what it wrote is available, and to which (stage, access) it is visible. A barrier on the
// subresource takes records into its first scope by their own stage or through a chain (a stage already ordered
// after them), and passes its second scope on to them. Then a use is right when
//   – a read has every write before it ordered, available and visible to each of its stages and accesses;
//   – a write has everything before it ordered, writes available too; a write that nobody has read yet must also be
//     visible to it (write after write), while one that a read has seen needs order alone (write after read);
//   – the subresource is in the layout that the use needs, and content that is needed was not dropped;
//   – a layout transition, being a write of its own, has everything before it in the first scope of its barrier.
// A resource that takes over memory inherits the records of everything that had any of its bytes before. Host states
// before and after the graph are uses like any other. Barriers act on their own resource alone, as in the validation
// layers. All stages in which a writing pass touches a subresource count as part of its write.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "rendergraph/declaration.h"
#include "rendergraph/plan.h"

namespace plan_checker {

enum class Hazard { readAfterWrite, writeAfterRead, writeAfterWrite, layout, alias, lostContent };

struct Finding {
  Hazard hazard;
  std::string text;
};

/// Dependencies that the plan lacks.
std::vector<Finding> findMissing(const rendergraph::Declaration& declaration, const rendergraph::Plan& plan);

struct Superfluous {
  std::vector<std::string> findings;
  uint32_t attempts = 0;  ///< Weakenings tried.
};
/// Weakens every barrier in every single way (without it, without one stage, one access, one mip or layer, with a
/// wrong layout) and reports each weakening after which nothing is missing. So it finds what is superfluous in a
/// plan, and at the same time shows that findMissing() notices every single fault.
Superfluous findSuperfluous(const rendergraph::Declaration& declaration, const rendergraph::Plan& plan);

}  // namespace plan_checker
