// compile(): the steps in their order, each a pure function in a file of its own:
// cells, validation, data flow, culling, usage flags and sizes, ordering, lifetimes, packing, attachments, barriers.
#include "rendergraph/compiler.h"

#include <algorithm>
#include <string>
#include <utility>

#include "rendergraph/aliasing.h"
#include "rendergraph/attachments.h"
#include "rendergraph/barriers.h"
#include "rendergraph/cells.h"
#include "rendergraph/culling.h"
#include "rendergraph/declaration.h"
#include "rendergraph/dependencies.h"
#include "rendergraph/error.h"
#include "rendergraph/ordering.h"
#include "rendergraph/timeline.h"
#include "rendergraph/validation.h"

namespace rendergraph {

namespace {

/// What living passes do with a resource.
struct ResourceUse {
  bool used = false;
  VkImageUsageFlags image = 0;
  VkBufferUsageFlags buffer = 0;
  MemoryRequirements requirements;  ///< Of resources that the graph creates.
};

std::vector<ResourceUse> findUses(const Declaration& declaration, const std::vector<uint8_t>& alive,
                                  const DeviceFacts& device) {
  std::vector<ResourceUse> uses(declaration.resources.size());
  for (const DeclaredAccess& access : declaration.accesses) {
    if (!alive[access.pass]) continue;
    const AccessRules rules = rulesOf(access.usage, access.mode, access.stages);
    ResourceUse& use = uses[access.resource];
    use.used = true;
    use.image |= rules.imageUsage;
    use.buffer |= rules.bufferUsage;
  }
  for (uint32_t index = 0; index < uses.size(); ++index) {
    const DeclaredResource& resource = declaration.resources[index];
    ResourceUse& use = uses[index];
    if (!use.used) continue;
    use.image |= resource.image.extraUsage;
    use.buffer |= resource.buffer.extraUsage;
    // The executor zeroes what it keeps.
    if (resource.retained()) {
      use.image |= VK_IMAGE_USAGE_TRANSFER_DST_BIT;
      use.buffer |= VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    }
    if (resource.isImage)
      use.buffer = 0;
    else
      use.image = 0;
    if (!resource.created()) continue;
    use.requirements = resource.isImage ? device.requirements(resource.image, use.image)
                                        : device.requirements(resource.buffer, use.buffer);
  }
  return uses;
}

[[noreturn]] void throwCycle(const Declaration& declaration, const std::vector<uint8_t>& alive,
                             const std::vector<uint32_t>& order) {
  std::vector<uint8_t> waiting = alive;
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

void addPlacements(const Declaration& declaration, const std::vector<ResourceUse>& uses, Plan& plan) {
  std::vector<uint32_t> placementOf(uses.size(), kNone);
  for (uint32_t index = 0; index < uses.size(); ++index) {
    const DeclaredResource& resource = declaration.resources[index];
    if (!uses[index].used) continue;
    if (resource.retained()) {
      plan.retained.push_back({.resource = index,
                               .imageUsage = uses[index].image,
                               .bufferUsage = uses[index].buffer,
                               .restLayout = restStateOf(resource).layout});
    }
    if (!resource.created()) continue;
    placementOf[index] = static_cast<uint32_t>(plan.placements.size());
    plan.placements.push_back({.resource = index,
                               .size = uses[index].requirements.size,
                               .firstStep = kNone,
                               .imageUsage = uses[index].image,
                               .bufferUsage = uses[index].buffer});
  }
  for (uint32_t step = 0; step < plan.passes.size(); ++step) {
    for (const DeclaredAccess& access : declaration.accessesOfPass(plan.passes[step].pass)) {
      if (placementOf[access.resource] == kNone) continue;
      Placement& placement = plan.placements[placementOf[access.resource]];
      placement.firstStep = std::min(placement.firstStep, step);
      placement.lastStep = step;
    }
  }
  const auto end = static_cast<uint32_t>(plan.passes.size());
  for (Placement& placement : plan.placements) {
    if (declaration.resources[placement.resource].exported) placement.lastStep = end;
  }
}

/// Placements that may share a block: same kind of memory, and a memory type that suits all of them.
struct HeapGroup {
  MemoryKind memory;
  uint32_t memoryTypeBits;
  std::vector<uint32_t> placements;
};

std::vector<HeapGroup> groupByMemory(const Declaration& declaration, const std::vector<ResourceUse>& uses,
                                     const Plan& plan) {
  std::vector<HeapGroup> groups;
  for (uint32_t index = 0; index < plan.placements.size(); ++index) {
    const uint32_t resource = plan.placements[index].resource;
    const DeclaredResource& declared = declaration.resources[resource];
    const MemoryKind memory = declared.isImage ? MemoryKind::device : declared.buffer.memory;
    const uint32_t bits = uses[resource].requirements.memoryTypeBits;
    auto group = std::find_if(groups.begin(), groups.end(), [&](const HeapGroup& candidate) {
      return candidate.memory == memory && (candidate.memoryTypeBits & bits) != 0;
    });
    if (group == groups.end()) group = groups.insert(groups.end(), {memory, bits, {}});
    group->memoryTypeBits &= bits;
    group->placements.push_back(index);
  }
  return groups;
}

Packing pack(std::span<const AliasItem> items, Aliasing aliasing) {
  switch (aliasing) {
    case Aliasing::none:
      return packSeparately(items);
    case Aliasing::fast:
      return packFast(items);
    case Aliasing::best:
      return packBest(items);
  }
  return {};
}

void packHeaps(const Declaration& declaration, const std::vector<ResourceUse>& uses, const PassOrder& order,
               Aliasing aliasing, Plan& plan) {
  std::vector<AliasItem> all;
  for (const HeapGroup& group : groupByMemory(declaration, uses, plan)) {
    std::vector<AliasItem> items;
    for (uint32_t index : group.placements) {
      const Placement& placement = plan.placements[index];
      items.push_back({.size = placement.size,
                       .alignment = std::max<VkDeviceSize>(1, uses[placement.resource].requirements.alignment),
                       .first = order.timeOf(placement.firstStep),
                       .last = order.timeOf(placement.lastStep)});
    }
    const Packing packing = pack(items, aliasing);
    for (uint32_t i = 0; i < group.placements.size(); ++i) {
      plan.placements[group.placements[i]].heap = static_cast<uint32_t>(plan.heaps.size());
      plan.placements[group.placements[i]].offset = packing.offsets[i];
    }
    plan.heaps.push_back({.size = packing.size, .memoryTypeBits = group.memoryTypeBits, .memory = group.memory});
    plan.memory.peakBytes += packing.size;
    plan.memory.unaliasedBytes += packSeparately(items).size;
    all.insert(all.end(), items.begin(), items.end());
  }
  plan.memory.lowerBound = largestLiveSum(all);
}

/// One queue: a submission ends after each host pass and at the end of the frame.
void addSubmissions(const Declaration& declaration, Plan& plan) {
  uint32_t first = 0;
  for (uint32_t step = 0; step < plan.passes.size(); ++step) {
    if (declaration.passes[plan.passes[step].pass].kind != PassKind::host) continue;
    plan.submissions.push_back({.steps = {first, step + 1 - first}});
    first = step + 1;
  }
  plan.submissions.push_back({.steps = {first, static_cast<uint32_t>(plan.passes.size()) - first}});
}

}  // namespace

Plan compile(const Declaration& declaration, const CompileOptions& options, const DeviceFacts& device) {
  const Cells cells(declaration);
  if (std::vector<GraphError::Problem> problems = findProblems(declaration, cells, device); !problems.empty()) {
    throw GraphError(std::move(problems));
  }
  Culling culling = cull(declaration, cells, dataFlow(declaration, cells));
  const std::vector<ResourceUse> uses = findUses(declaration, culling.alive, device);

  std::vector<VkDeviceSize> bytes;
  for (const ResourceUse& use : uses) bytes.push_back(use.requirements.size);
  const PassOrder order =
      orderPasses(declaration, culling.alive, orderingEdges(declaration, cells, culling.alive), bytes, options);
  if (order.passes.size() + culling.culled.size() != declaration.passes.size()) {
    throwCycle(declaration, culling.alive, order.passes);
  }

  Plan plan;
  plan.culled = std::move(culling.culled);
  plan.passes.resize(order.passes.size());
  for (uint32_t step = 0; step < order.passes.size(); ++step) plan.passes[step].pass = order.passes[step];
  addSubmissions(declaration, plan);
  addPlacements(declaration, uses, plan);
  packHeaps(declaration, uses, order, options.aliasing, plan);
  const Timeline timeline(declaration, cells, order.passes);
  planAttachments(declaration, cells, timeline, plan);
  planBarriers(declaration, cells, timeline, plan);
  return plan;
}

}  // namespace rendergraph
