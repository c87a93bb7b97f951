// On several queues a resource counts as alive until the last step that may run beside its last use, so that nothing
// has to wait for memory that it would not wait for otherwise.
#include "rendergraph/compile/memory/placements.h"

#include <algorithm>
#include <vector>

#include "rendergraph/compile/memory/packing.h"
#include "rendergraph/compile/schedule/schedule.h"
#include "rendergraph/compile/schedule/submissions.h"
#include "rendergraph/declare/declaration.h"

namespace lensgraph::rendergraph {

namespace {

class Placer {
 public:
  Placer(const Declaration& declaration, std::span<const ResourceNeed> uses, std::span<const Sharing> sharing,
         const Schedule& schedule, const Submissions& submissions, Plan& plan)
      : declaration_(declaration),
        uses_(uses),
        sharing_(sharing),
        schedule_(schedule),
        submissions_(submissions),
        plan_(plan),
        placementOf_(uses.size(), kNone) {}

  void addAll() {
    plan_.placements.reserve(uses_.size());
    for (uint32_t index = 0; index < uses_.size(); ++index) add(index);
    aliveFrom_.assign(plan_.placements.size(), kNone);
    aliveUntil_.assign(plan_.placements.size(), 0);
    findLives();
  }

  void pack(Aliasing aliasing) {
    items_.reserve(plan_.placements.size());
    for (uint32_t index = 0; index < plan_.placements.size(); ++index) {
      const Placement& placement = plan_.placements[index];
      items_.push_back({.size = placement.size,
                        .alignment = std::max<VkDeviceSize>(1, uses_[placement.resource].requirements.alignment),
                        .first = schedule_.timeOf(aliveFrom_[index]),
                        .last = schedule_.timeOf(aliveUntil_[index])});
    }
    plan_.memory.lowerBound = largestLiveSum(items_);
    for (const Group& group : groups()) packGroup(group, aliasing);
  }

 private:
  /// Placements that may share a block: same kind of memory, and a memory type that suits all of them.
  struct Group {
    MemoryKind memory;
    uint32_t memoryTypeBits;
    bool dedicated;
    std::vector<uint32_t> placements;
  };

  void add(uint32_t index) {
    const DeclaredResource& resource = declaration_.resources[index];
    const ResourceNeed& use = uses_[index];
    if (!use.used || resource.imported()) return;
    const bool concurrent = !sharing_.empty() && sharing_[index] == Sharing::concurrent;
    if (resource.persistent()) {
      plan_.persistent.push_back({.resource = index,
                                  .imageUsage = use.image,
                                  .bufferUsage = use.buffer,
                                  .restLayout = restStateOf(resource).layout,
                                  .concurrent = concurrent});
      return;
    }
    placementOf_[index] = static_cast<uint32_t>(plan_.placements.size());
    plan_.placements.push_back({.resource = index,
                                .size = use.requirements.size,
                                .firstStep = kNone,
                                .imageUsage = use.image,
                                .bufferUsage = use.buffer,
                                .concurrent = concurrent});
  }

  void findLives() {
    for (uint32_t step = 0; step < schedule_.steps(); ++step) {
      const uint32_t first = schedule_.unitFirst[step], last = schedule_.unitLast[step];
      for (const DeclaredAccess& access : declaration_.accessesOfPass(schedule_.order[step])) {
        const uint32_t found = placementOf_[access.resource];
        if (found == kNone) continue;
        Placement& placement = plan_.placements[found];
        placement.firstStep = std::min(placement.firstStep, step);
        placement.lastStep = std::max(placement.lastStep, step);
        aliveFrom_[found] = std::min(aliveFrom_[found], first);
        aliveUntil_[found] = std::max({aliveUntil_[found], last, submissions_.lastConcurrent[step]});
      }
    }
    for (uint32_t index = 0; index < plan_.placements.size(); ++index) {
      Placement& placement = plan_.placements[index];
      if (declaration_.resources[placement.resource].exported) {
        placement.lastStep = aliveUntil_[index] = schedule_.steps();
      }
    }
  }

  std::vector<Group> groups() const {
    std::vector<Group> groups;
    for (uint32_t index = 0; index < plan_.placements.size(); ++index) {
      const uint32_t resource = plan_.placements[index].resource;
      const DeclaredResource& declared = declaration_.resources[resource];
      const MemoryKind memory = declared.isImage ? MemoryKind::device : declared.buffer.memory;
      const MemoryRequirements& needs = uses_[resource].requirements;
      auto group = std::find_if(groups.begin(), groups.end(), [&](const Group& candidate) {
        return !needs.dedicated && !candidate.dedicated && candidate.memory == memory &&
               (candidate.memoryTypeBits & needs.memoryTypeBits) != 0;
      });
      if (group == groups.end()) {
        group = groups.insert(groups.end(), {memory, needs.memoryTypeBits, needs.dedicated, {}});
      }
      group->memoryTypeBits &= needs.memoryTypeBits;
      group->placements.push_back(index);
    }
    return groups;
  }

  static Packing packed(std::span<const AliasItem> items, Aliasing aliasing) {
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

  void packGroup(const Group& group, Aliasing aliasing) {
    std::vector<AliasItem> items;
    items.reserve(group.placements.size());
    for (uint32_t index : group.placements) items.push_back(items_[index]);
    const Packing packing = packed(items, aliasing);
    for (uint32_t i = 0; i < group.placements.size(); ++i) {
      Placement& placement = plan_.placements[group.placements[i]];
      placement.heap = static_cast<uint32_t>(plan_.heaps.size());
      placement.offset = packing.offsets[i];
    }
    plan_.heaps.push_back({.size = packing.size,
                           .memoryTypeBits = group.memoryTypeBits,
                           .memory = group.memory,
                           .dedicated = group.dedicated});
    plan_.memory.peakBytes += packing.size;
    VkDeviceSize separate = 0;
    for (const AliasItem& item : items) separate = alignUp(separate, item.alignment) + item.size;
    plan_.memory.unaliasedBytes += separate;
  }

  const Declaration& declaration_;
  std::span<const ResourceNeed> uses_;
  std::span<const Sharing> sharing_;
  const Schedule& schedule_;
  const Submissions& submissions_;
  Plan& plan_;
  std::vector<uint32_t> placementOf_;  // By resource.
  /// By placement: steps. Longer than its uses where passes share a rendering or run beside each other.
  std::vector<uint32_t> aliveFrom_, aliveUntil_;
  std::vector<AliasItem> items_;  // By placement.
};

}  // namespace

void placeResources(const Declaration& declaration, std::span<const ResourceNeed> uses,
                    std::span<const Sharing> sharing, const Schedule& schedule, const Submissions& submissions,
                    Aliasing aliasing, Plan& plan) {
  Placer placer(declaration, uses, sharing, schedule, submissions, plan);
  placer.addAll();
  placer.pack(aliasing);
}

}  // namespace lensgraph::rendergraph
