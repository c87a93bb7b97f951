// What the declaration and the plan do to one resource, in order: uses, attachment operations, barriers.
#include <algorithm>

#include "plan_checker/resource_replay.h"

namespace lensgraph::plan_checker {

using namespace rendergraph;

namespace {

VkImageLayout layoutOf(const std::vector<Usage>& usages) {
  if (usages.empty()) return VK_IMAGE_LAYOUT_UNDEFINED;
  VkImageLayout layout = layoutFor(usages.front());
  for (Usage usage : usages) {
    if (layoutFor(usage) == layout) continue;
    const bool depth = usage == Usage::depthReadOnly || layout == VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL;
    layout = depth ? VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL : VK_IMAGE_LAYOUT_GENERAL;
  }
  return layout;
}

}  // namespace

ResourceReplay::ResourceReplay(const Setting& setting, const PlanOrder& order, uint32_t resource,
                               std::vector<Placed> barriers, const std::vector<uint32_t>& accesses,
                               const std::vector<uint32_t>& stepOfPass)
    : setting_(setting),
      order_(order),
      resource_(resource),
      declared_(setting.declaration.resources[resource]),
      barriers_(std::move(barriers)) {
  if (declared_.isImage) {
    mips_ = declared_.image.mips;
    layers_ = declared_.image.layers;
    for (VkImageAspectFlags bit = 1; bit <= VK_IMAGE_ASPECT_STENCIL_BIT; bit <<= 1) {
      if ((aspectsOf(declared_.image.format) & bit) != 0) aspects_.push_back(bit);
    }
  } else {
    aspects_.push_back(0);
  }
  for (const Placement& placement : setting.plan.placements) {
    if (placement.resource == resource) concurrent_ = placement.concurrent;
  }
  for (const PersistentResource& persistent : setting.plan.persistent) {
    if (persistent.resource == resource) concurrent_ = persistent.concurrent;
  }
  collectUses(accesses, stepOfPass);
  collectOps();
}

void ResourceReplay::collectUses(const std::vector<uint32_t>& accesses, const std::vector<uint32_t>& stepOfPass) {
  std::vector<std::pair<uint32_t, uint32_t>> ordered;  // Step, access.
  for (uint32_t access : accesses) {
    const uint32_t step = stepOfPass[setting_.declaration.accesses[access].pass];
    if (step != UINT32_MAX) ordered.emplace_back(step, access);
  }
  std::sort(ordered.begin(), ordered.end());
  std::vector<uint32_t> together;
  for (std::size_t i = 0; i < ordered.size(); ++i) {
    together.push_back(ordered[i].second);
    if (i + 1 < ordered.size() && ordered[i + 1].first == ordered[i].first) continue;
    addUse(ordered[i].first, together);
    together.clear();
  }
}

void ResourceReplay::addUse(uint32_t step, const std::vector<uint32_t>& accesses) {
  StepUse use{.step = step, .queue = setting_.plan.passes[step].queue, .submission = order_.submissionOf(step)};
  use.uses.resize(count());
  for (uint32_t index : accesses) {
    const DeclaredAccess& access = setting_.declaration.accesses[index];
    forEach(access.range, [&](uint32_t i) { addAccess(use.uses[i], access); });
  }
  if (declared_.isImage) agreeOnLayouts(use.uses, accesses);
  addOperations(use, accesses);
  uses_.push_back(std::move(use));
}

void ResourceReplay::agreeOnLayouts(std::vector<Use>& uses, const std::vector<uint32_t>& accesses) const {
  std::vector<std::vector<Usage>> usages(uses.size());
  for (uint32_t index : accesses) {
    const DeclaredAccess& access = setting_.declaration.accesses[index];
    forEach(access.range, [&](uint32_t i) { usages[i].push_back(access.usage); });
  }
  for (uint32_t i = 0; i < uses.size(); ++i) uses[i].layout = layoutOf(usages[i]);
  // One binding has one layout: a declared range of which a part had to change layout changes as a whole.
  for (bool changing = true; changing;) {
    changing = false;
    for (uint32_t index : accesses) {
      const DeclaredAccess& access = setting_.declaration.accesses[index];
      VkImageLayout common = layoutFor(access.usage);
      forEach(access.range, [&](uint32_t i) {
        if (uses[i].layout != layoutFor(access.usage)) common = uses[i].layout;
      });
      forEach(access.range, [&](uint32_t i) {
        changing = changing || uses[i].layout != common;
        uses[i].layout = common;
      });
    }
  }
}

void ResourceReplay::addOperations(StepUse& use, const std::vector<uint32_t>& accesses) const {
  const PlannedPass& planned = setting_.plan.passes[use.step];
  for (const Run& run : {planned.colors, planned.depth}) {
    for (uint32_t index = run.first; index < run.first + run.count; ++index) {
      const PlannedAttachment& attachment = setting_.plan.attachments[index];
      if (attachment.resource != resource_) continue;
      for (uint32_t i : accesses) {
        const DeclaredAccess& access = setting_.declaration.accesses[i];
        const bool same = access.role == AttachmentRole::color || access.role == AttachmentRole::depth;
        if (!same || !(access.range == attachment.range)) continue;
        use.operations.push_back({.attachment = index,
                                  .range = access.range,
                                  .needsContent = access.mode != AccessMode::write,
                                  .clears = access.load == LoadOp::clear && access.mode == AccessMode::write,
                                  .begins = order_.renderingOf(use.step) == use.step,
                                  .ends = order_.endsRendering(use.step)});
      }
    }
  }
}

void ResourceReplay::collectOps() {
  ops_.clear();
  for (uint32_t i = 0; i < barriers_.size(); ++i) {
    ops_.push_back({barriers_[i].key, i, Kind::barrier});
    if (barriers_[i].setKey != 0) ops_.push_back({barriers_[i].setKey, i, Kind::set});
  }
  for (uint32_t i = 0; i < uses_.size(); ++i) ops_.push_back({order_.keysOf(uses_[i].step).use, i, Kind::use});
  std::stable_sort(ops_.begin(), ops_.end(), [](const Op& a, const Op& b) { return a.key < b.key; });
}

void ResourceReplay::replaceBarrier(uint32_t index, const Placed& placed) {
  barriers_[index] = placed;
  collectOps();
}

std::vector<std::pair<uint32_t, bool>> ResourceReplay::operations() const {
  std::vector<std::pair<uint32_t, bool>> result;
  for (const StepUse& use : uses_) {
    for (const Operation& operation : use.operations) {
      const PlannedAttachment& planned = setting_.plan.attachments[operation.attachment];
      if (operation.begins && planned.load != VK_ATTACHMENT_LOAD_OP_DONT_CARE) {
        result.emplace_back(operation.attachment, true);
      }
      if (operation.ends && planned.store == VK_ATTACHMENT_STORE_OP_STORE) {
        result.emplace_back(operation.attachment, false);
      }
    }
  }
  return result;
}

bool ResourceReplay::usedThroughout() const {
  std::vector<bool> used(count(), false);
  for (const StepUse& use : uses_) {
    for (uint32_t i = 0; i < use.uses.size(); ++i) used[i] = used[i] || use.uses[i].stages != 0;
  }
  return std::find(used.begin(), used.end(), false) == used.end();
}

}  // namespace lensgraph::plan_checker
