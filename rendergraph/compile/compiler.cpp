// compile(): the steps in their order, each a pure function in a file of its own.
#include "rendergraph/compiler.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>

#include "rendergraph/compile/attachments.h"
#include "rendergraph/compile/flow/cells.h"
#include "rendergraph/compile/flow/culling.h"
#include "rendergraph/compile/flow/dependencies.h"
#include "rendergraph/compile/flow/resource_needs.h"
#include "rendergraph/compile/flow/validation.h"
#include "rendergraph/compile/memory/placements.h"
#include "rendergraph/compile/schedule/cell_uses.h"
#include "rendergraph/compile/schedule/ordering.h"
#include "rendergraph/compile/schedule/queues.h"
#include "rendergraph/compile/schedule/raster_merging.h"
#include "rendergraph/compile/schedule/schedule.h"
#include "rendergraph/compile/schedule/submissions.h"
#include "rendergraph/compile/sync/plan_barriers.h"
#include "rendergraph/declare/declaration.h"
#include "rendergraph/error.h"

namespace lensgraph::rendergraph {

namespace {

[[noreturn]] void throwCycle(const Declaration& declaration, const std::vector<uint32_t>& order) {
  std::vector<uint8_t> waiting(declaration.passes.size(), 1);
  for (uint32_t pass : order) waiting[pass] = 0;
  const auto first = static_cast<uint32_t>(std::find(waiting.begin(), waiting.end(), 1) - waiting.begin());
  std::string names;
  for (uint32_t pass = 0; pass < waiting.size(); ++pass) {
    if (!waiting[pass]) continue;
    names += (names.empty() ? "'" : ", '") + std::string(declaration.passes[pass].name) + "'";
  }
  throw GraphError({declaration.problem(Misuse::cycle, first, kNone, "these passes wait for each other: " + names,
                                        "declare all accesses of a pass before those of the next, or split one",
                                        declaration.passes[first].where)});
}

/// All passes, in an order in which they can run: that of declaration, unless accesses were declared in turns.
std::vector<uint32_t> anyOrder(const Declaration& declaration, const Cells& cells) {
  const std::size_t passes = declaration.passes.size();
  std::vector<uint32_t> order(passes);
  std::iota(order.begin(), order.end(), 0u);
  if (declaration.inOrder) return order;
  const std::vector<uint8_t> all(passes, 1);
  order = orderPasses(declaration, all, orderingEdges(declaration, cells, all), {}, {.order = Order::declared}).passes;
  if (order.size() != passes) throwCycle(declaration, order);
  return order;
}

PassOrder chosenOrder(const Declaration& declaration, const Cells& cells, const std::vector<uint8_t>& alive,
                      const std::vector<ResourceNeed>& uses, std::vector<uint32_t> sequence,
                      const CompileOptions& options) {
  if (options.order == Order::declared) {
    std::erase_if(sequence, [&](uint32_t pass) { return !alive[pass]; });
    return {std::move(sequence), {}};
  }
  std::vector<VkDeviceSize> bytes;
  bytes.reserve(uses.size());
  for (const ResourceNeed& use : uses) bytes.push_back(use.requirements.size);
  return orderPasses(declaration, alive, orderingEdges(declaration, cells, alive), bytes, options);
}

void addPasses(const Schedule& schedule, Plan& plan) {
  plan.passes.resize(schedule.steps());
  for (uint32_t step = 0; step < schedule.steps(); ++step) {
    plan.passes[step].pass = schedule.order[step];
    plan.passes[step].queue = schedule.queue[step];
  }
}

}  // namespace

Plan compile(const Declaration& declaration, const CompileOptions& options, const DeviceFacts& device) {
  const Cells cells(declaration);
  if (std::vector<GraphError::Problem> problems = findProblems(declaration, cells, device); !problems.empty()) {
    throw GraphError(std::move(problems));
  }
  std::vector<uint32_t> sequence = anyOrder(declaration, cells);
  Culling culling = cull(declaration, cells, sequence);
  const std::vector<ResourceNeed> uses = findResourceNeeds(declaration, culling.alive, device);

  Schedule schedule;
  PassOrder order = chosenOrder(declaration, cells, culling.alive, uses, std::move(sequence), options);
  schedule.order = std::move(order.passes);
  schedule.group = std::move(order.groups);
  assignQueues(declaration, device.queues(), options.useQueues, schedule);
  mergeRasterPasses(declaration, options.mergeRasterPasses, schedule);
  CellUses cellUses(declaration, cells, schedule);
  const std::vector<Sharing> sharing = sharingOf(declaration, cells, cellUses, schedule, device.queues());
  Submissions submissions = planSubmissions(declaration, cells, cellUses, sharing, options.overlappingFrames, schedule);
  if (schedule.severalQueues) cellUses = CellUses(declaration, cells, schedule);

  Plan plan;
  plan.culled = std::move(culling.culled);
  addPasses(schedule, plan);
  placeResources(declaration, uses, sharing, schedule, submissions, options.aliasing, plan);
  plan.submissions = std::move(submissions.list);
  plan.submissionWaits = std::move(submissions.waits);
  planAttachments(declaration, cells, cellUses, schedule, plan);
  planBarriers({.declaration = declaration,
                .options = options,
                .cells = cells,
                .cellUses = cellUses,
                .schedule = schedule,
                .submissions = submissions,
                .sharing = sharing,
                .queues = device.queues()},
               plan);
  return plan;
}

}  // namespace lensgraph::rendergraph
