// Replays plans; see the header for the model.
#include "plan_checker.h"

#include <algorithm>
#include <map>
#include <optional>
#include <sstream>

#include "usage_model.h"

namespace plan_checker {

using namespace rendergraph;

namespace {

/// What remains of an earlier use, for the later ones to respect.
struct Record {
  bool write = false;
  bool transition = false;  // By a layout transition: at no stage, always available.
  bool seen = false;        // A read has seen it.
  bool inherited = false;   // Of another resource in the same memory.
  bool available = false;
  StageMask stage = 0;  // One bit.
  VkAccessFlags2 access = 0;
  StageMask ordered = 0;
  Touches visible{};
  uint32_t pass = 0;
  bool operator==(const Record&) const = default;
};

struct Placed {
  uint32_t step;
  ImageBarrier barrier;  // Of buffers too; their layouts stay UNDEFINED.
};

/// One mip of one layer of one aspect, or a buffer.
struct Subresource {
  VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
  VkImageLayout lastUsed = VK_IMAGE_LAYOUT_UNDEFINED;  // Layout of the last use, or before the graph.
  bool hasContent = false;
  bool shouldHaveContent = false;  // If no barrier had dropped it.
  bool used = false;
  std::vector<Record> records;
};

bool inFirstScope(const Record& record, StageMask source) {
  return (record.stage & source) != 0 || (record.ordered & source) != 0;
}

void applyBarrier(Record& record, const ImageBarrier& barrier) {
  const StageMask source = stageMask(barrier.from.stages), target = stageMask(barrier.to.stages);
  if (!inFirstScope(record, source)) return;
  const bool covered = (record.access & kWrites & ~accessMask(barrier.from.access)) == 0;
  if (record.write && (record.stage & source) != 0 && covered) record.available = true;
  record.ordered |= target;
  if (!record.available) return;
  for (uint32_t i = 0; i < kStageCount; ++i) {
    if ((target >> i & 1) != 0) record.visible[i] |= accessMask(barrier.to.access);
  }
}

class Replay {
 public:
  Replay(const Declaration& declaration, const Plan& plan, uint32_t resource)
      : declaration_(declaration), plan_(plan), resource_(resource), declared_(declaration.resources[resource]) {
    if (declared_.isImage) {
      mips_ = declared_.image.mips;
      layers_ = declared_.image.layers;
      for (VkImageAspectFlags bit = 1; bit <= VK_IMAGE_ASPECT_STENCIL_BIT; bit <<= 1) {
        if ((aspectsOf(declared_.image.format) & bit) != 0) aspects_.push_back(bit);
      }
    } else {
      aspects_.push_back(0);
    }
    collectUses();
  }

  bool used() const { return !uses_.empty(); }
  uint32_t firstStep() const { return uses_.front().first; }
  uint32_t lastStep() const { return uses_.back().first; }

  /// Runs through time with these barriers; `inherited` are the records of the memory's earlier owners.
  void run(const std::vector<Placed>& barriers, const std::vector<Record>& inherited, std::vector<Finding>* findings) {
    findings_ = findings;
    failed_ = false;
    start(inherited);
    auto barrier = barriers.begin();
    for (const auto& [step, uses] : uses_) {
      for (; barrier != barriers.end() && barrier->step <= step; ++barrier) apply(*barrier);
      for (uint32_t i = 0; i < subresources_.size(); ++i) {
        if (uses[i].stages != 0) check(subresources_[i], uses[i], plan_.passes[step].pass, step);
      }
    }
    for (; barrier != barriers.end(); ++barrier) apply(*barrier);
    finish();
  }
  bool failed() const { return failed_; }

  /// Whether every subresource was used, and so has waited for the earlier owners of its memory.
  bool usedThroughout() const {
    std::vector<bool> used(count(), false);
    for (const auto& [step, uses] : uses_) {
      for (uint32_t i = 0; i < uses.size(); ++i) used[i] = used[i] || uses[i].stages != 0;
    }
    return std::find(used.begin(), used.end(), false) == used.end();
  }

  /// What later owners of the memory have to respect.
  std::vector<Record> remaining() const {
    std::vector<Record> result;
    for (const Subresource& subresource : subresources_) {
      if (!subresource.used) continue;
      for (Record record : subresource.records) {
        record.inherited = true;
        if (std::find(result.begin(), result.end(), record) == result.end()) result.push_back(record);
      }
    }
    return result;
  }

 private:
  uint32_t count() const { return static_cast<uint32_t>(aspects_.size()) * mips_ * layers_; }

  template <class F>
  void forEach(const Subresources& range, F&& use) const {
    if (!declared_.isImage) return use(0);
    for (uint32_t a = 0; a < aspects_.size(); ++a) {
      if ((range.aspects & aspects_[a]) == 0) continue;
      for (uint32_t mip = range.firstMip; mip < range.firstMip + range.mipCount; ++mip) {
        for (uint32_t layer = range.firstLayer; layer < range.firstLayer + range.layerCount; ++layer) {
          use((a * mips_ + mip) * layers_ + layer);
        }
      }
    }
  }

  void collectUses() {
    for (uint32_t step = 0; step < plan_.passes.size(); ++step) {
      std::vector<Use> uses(count());
      std::vector<std::vector<Usage>> usages(count());
      bool any = false;
      for (const DeclaredAccess& access : declaration_.accesses) {
        if (access.pass != plan_.passes[step].pass || access.resource != resource_) continue;
        any = true;
        forEach(access.range, [&](uint32_t i) {
          addAccess(uses[i], access);
          usages[i].push_back(access.usage);
        });
      }
      if (!any) continue;
      for (uint32_t i = 0; i < uses.size(); ++i) uses[i].layout = layoutOf(usages[i]);
      spreadGeneral(plan_.passes[step].pass, uses);
      uses_.emplace_back(step, std::move(uses));
    }
  }

  VkImageLayout layoutOf(const std::vector<Usage>& usages) const {
    if (!declared_.isImage || usages.empty()) return VK_IMAGE_LAYOUT_UNDEFINED;
    VkImageLayout layout = layoutFor(usages.front());
    for (Usage usage : usages) {
      if (layoutFor(usage) == layout) continue;
      const bool depth = usage == Usage::depthReadOnly || layout == VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL;
      layout = depth ? VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL : VK_IMAGE_LAYOUT_GENERAL;
    }
    return layout;
  }

  /// One binding has one layout: a declared range of which a part had to change layout changes as a whole.
  void spreadGeneral(uint32_t pass, std::vector<Use>& uses) const {
    for (int round = 0; round < 8; ++round) {
      for (const DeclaredAccess& access : declaration_.accesses) {
        if (access.pass != pass || access.resource != resource_ || !declared_.isImage) continue;
        VkImageLayout changed = layoutFor(access.usage);
        forEach(access.range, [&](uint32_t i) {
          if (uses[i].layout != layoutFor(access.usage)) changed = uses[i].layout;
        });
        forEach(access.range, [&](uint32_t i) { uses[i].layout = changed; });
      }
    }
  }

  void start(const std::vector<Record>& inherited) {
    subresources_.assign(count(), {});
    for (Subresource& subresource : subresources_) {
      subresource.records = inherited;
      if (declared_.created()) continue;
      subresource.hasContent = true;
      if (declared_.retained()) {
        subresource.layout = restLayout();
      } else {
        subresource.layout = declared_.isImage ? declared_.before.layout : VK_IMAGE_LAYOUT_UNDEFINED;
        subresource.hasContent = !declared_.isImage || subresource.layout != VK_IMAGE_LAYOUT_UNDEFINED;
        addHostRecords(subresource);
      }
      subresource.shouldHaveContent = subresource.hasContent;
      subresource.lastUsed = subresource.layout;
    }
  }

  VkImageLayout restLayout() const {
    if (!declared_.isImage) return VK_IMAGE_LAYOUT_UNDEFINED;
    return declared_.exported ? declared_.after.layout : VK_IMAGE_LAYOUT_GENERAL;
  }

  void addHostRecords(Subresource& subresource) const {
    const VkAccessFlags2 access = accessMask(declared_.before.access);
    const StageMask stages = stageMask(declared_.before.stages);
    const bool write = (access & kWrites) != 0;
    for (uint32_t i = 0; i < kStageCount; ++i) {
      if ((stages >> i & 1) == 0) continue;
      subresource.records.push_back(
          {.write = write, .stage = 1u << i, .access = access, .pass = AccessPoint::kOutside});
    }
    if (stages == 0 || write) return;
    // Whoever wrote it before has made it visible to the host's reads, and to nothing else as far as we know.
    Record content{.write = true,
                   .transition = true,
                   .seen = true,
                   .available = true,
                   .ordered = stages,
                   .pass = AccessPoint::kOutside};
    for (uint32_t i = 0; i < kStageCount; ++i) content.visible[i] = (stages >> i & 1) != 0 ? access : 0;
    subresource.records.push_back(content);
  }

  void apply(const Placed& placed) {
    forEach(placed.barrier.range, [&](uint32_t i) { apply(subresources_[i], placed); });
  }

  void apply(Subresource& subresource, const Placed& placed) {
    const ImageBarrier& barrier = placed.barrier;
    const bool dropping = barrier.oldLayout == VK_IMAGE_LAYOUT_UNDEFINED;
    if (declared_.isImage && !dropping && barrier.oldLayout != subresource.layout) {
      fail(Hazard::layout, placed.step, "the barrier's old layout is not the current one");
    }
    const bool transition = declared_.isImage && barrier.oldLayout != barrier.newLayout;
    const StageMask source = stageMask(barrier.from.stages);
    for (Record& record : subresource.records) {
      const bool waited = inFirstScope(record, source);
      applyBarrier(record, barrier);
      if (!transition || (waited && (!record.write || record.available))) continue;
      fail(record.inherited ? Hazard::alias : Hazard::layout, placed.step,
           "a layout transition does not wait for " + nameOfPass(record.pass));
    }
    if (!transition) return;
    subresource.layout = barrier.newLayout;
    if (dropping) subresource.hasContent = false;
    Record written{.write = true,
                   .transition = true,
                   .available = true,
                   .ordered = stageMask(barrier.to.stages),
                   .pass = barrier.to.pass};
    for (uint32_t i = 0; i < kStageCount; ++i) {
      if ((written.ordered >> i & 1) != 0) written.visible[i] = accessMask(barrier.to.access);
    }
    subresource.records = {written};
  }

  void check(Subresource& subresource, const Use& use, uint32_t pass, uint32_t step) {
    subresource.used = true;
    subresource.lastUsed = use.layout;
    if (declared_.isImage && subresource.layout != use.layout) fail(Hazard::layout, step, "wrong layout");
    if (use.reads && !subresource.hasContent) fail(Hazard::lostContent, step, "its content was dropped");
    for (Record& record : subresource.records) checkAgainst(record, use, step);
    if (use.writes) {
      subresource.records.clear();
      subresource.hasContent = subresource.shouldHaveContent = true;
    }
    for (uint32_t i = 0; i < kStageCount; ++i) {
      if ((use.stages >> i & 1) == 0) continue;
      subresource.records.push_back({.write = use.writes, .stage = 1u << i, .access = use.touches[i], .pass = pass});
    }
  }

  void checkAgainst(Record& record, const Use& use, uint32_t step) {
    if (!record.write && !use.writes) return;
    const Hazard hazard = record.inherited ? Hazard::alias
                          : !record.write  ? Hazard::writeAfterRead
                          : use.reads      ? Hazard::readAfterWrite
                                           : Hazard::writeAfterWrite;
    if ((use.stages & ~record.ordered) != 0) {
      fail(hazard, step, "it does not wait for " + nameOfPass(record.pass));
      return;
    }
    if (!record.write) return;
    if (!record.available) fail(hazard, step, "what " + nameOfPass(record.pass) + " wrote is not available");
    for (uint32_t i = 0; i < kStageCount; ++i) {
      VkAccessFlags2 needed = use.touches[i];
      if (record.seen) needed = use.reads ? needed & kReads : 0;
      if ((needed & ~record.visible[i]) != 0) {
        fail(hazard, step, "what " + nameOfPass(record.pass) + " wrote is not visible");
        return;
      }
    }
    record.seen = record.seen || use.reads;
  }

  void finish() {
    const auto end = static_cast<uint32_t>(plan_.passes.size());
    for (Subresource& subresource : subresources_) {
      if (declared_.created() && !declared_.exported) continue;
      if (declared_.retained() && !subresource.used) continue;
      AccessState after = declared_.after;
      if (declared_.retained()) {
        after = {VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT,
                 restLayout()};
      }
      if (subresource.shouldHaveContent && !subresource.hasContent) {
        fail(Hazard::lostContent, end, "its content was dropped before the host sees it");
      }
      if (after.layout == VK_IMAGE_LAYOUT_UNDEFINED) after.layout = subresource.lastUsed;
      if (declared_.isImage && subresource.layout != after.layout) {
        fail(Hazard::layout, end, "it is not left in the layout that the host asked for");
      }
      if (after.stages == 0) continue;
      Use use{.layout = subresource.layout, .reads = true, .writes = (accessMask(after.access) & kWrites) != 0};
      use.add(stageMask(after.stages), accessMask(after.access));
      for (Record& record : subresource.records) checkAgainst(record, use, end);
    }
  }

  std::string nameOfPass(uint32_t pass) const {
    return pass < declaration_.passes.size() ? "'" + std::string(declaration_.passes[pass].name) + "'" : "the host";
  }

  void fail(Hazard hazard, uint32_t step, const std::string& why) {
    failed_ = true;
    if (findings_ == nullptr) return;
    const std::string pass = step < plan_.passes.size() ? nameOfPass(plan_.passes[step].pass) : "after the graph";
    findings_->push_back({hazard, pass + ", '" + std::string(declared_.name) + "': " + why});
  }

  const Declaration& declaration_;
  const Plan& plan_;
  uint32_t resource_;
  const DeclaredResource& declared_;
  uint32_t mips_ = 1, layers_ = 1;
  std::vector<VkImageAspectFlags> aspects_;
  std::vector<std::pair<uint32_t, std::vector<Use>>> uses_;  // By step.
  std::vector<Subresource> subresources_;
  std::vector<Finding>* findings_ = nullptr;
  bool failed_ = false;
};

std::vector<std::vector<Placed>> barriersByResource(const Declaration& declaration, const Plan& plan) {
  std::vector<std::vector<Placed>> result(declaration.resources.size());
  const auto add = [&](uint32_t step, const BarrierBatch& batch) {
    for (const ImageBarrier& barrier : plan.imagesOf(batch)) result[barrier.resource].push_back({step, barrier});
    for (const BufferBarrier& barrier : plan.buffersOf(batch)) {
      ImageBarrier placed;
      placed.from = barrier.from;
      placed.to = barrier.to;
      placed.range = {0, 1, 0, 1, 0};
      result[barrier.resource].push_back({step, placed});
    }
  };
  for (uint32_t step = 0; step < plan.passes.size(); ++step) add(step, plan.passes[step].before);
  add(static_cast<uint32_t>(plan.passes.size()), plan.submissions.back().atEnd);
  return result;
}

/// Everything needed to replay one resource again and again.
struct Case {
  Replay replay;
  std::vector<Placed> barriers;
  std::vector<Record> inherited;
};

struct OwnedBytes {
  uint32_t heap;
  VkDeviceSize begin, end;
  uint32_t resource;
};

/// Replays all resources once, in the order in which they come to life, and hands records on through memory.
std::vector<Case> replayAll(const Declaration& declaration, const Plan& plan, std::vector<Finding>& findings) {
  std::vector<std::vector<Placed>> barriers = barriersByResource(declaration, plan);
  std::vector<Case> cases;
  std::map<uint32_t, const Placement*> placements;
  for (const Placement& placement : plan.placements) placements[placement.resource] = &placement;
  std::vector<uint32_t> order;
  for (uint32_t i = 0; i < declaration.resources.size(); ++i) {
    cases.push_back({Replay(declaration, plan, i), std::move(barriers[i]), {}});
    order.push_back(i);
  }
  const auto startOf = [&](uint32_t i) { return cases[i].replay.used() ? cases[i].replay.firstStep() : 0u; };
  std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return startOf(a) < startOf(b); });

  std::vector<OwnedBytes> memory;
  for (uint32_t i : order) {
    const auto placed = placements.find(i);
    if (placed != placements.end() && cases[i].replay.used()) {
      const Placement& p = *placed->second;
      const VkDeviceSize begin = p.offset, end = p.offset + p.size;
      std::vector<OwnedBytes> left;
      for (const OwnedBytes& owned : memory) {
        if (owned.heap != p.heap || owned.end <= begin || end <= owned.begin) {
          left.push_back(owned);
          continue;
        }
        const bool exported = declaration.resources[owned.resource].exported;
        if (exported || cases[owned.resource].replay.lastStep() >= cases[i].replay.firstStep()) {
          findings.push_back({Hazard::alias, "'" + std::string(declaration.resources[i].name) + "' overlaps living '" +
                                                 std::string(declaration.resources[owned.resource].name) + "'"});
        }
        for (const Record& record : cases[owned.resource].replay.remaining()) {
          auto& known = cases[i].inherited;
          if (std::find(known.begin(), known.end(), record) == known.end()) known.push_back(record);
        }
        if (!cases[i].replay.usedThroughout()) {
          left.push_back(owned);  // Nobody knows where in the memory the unused part lies.
          continue;
        }
        if (owned.begin < begin) left.push_back({owned.heap, owned.begin, begin, owned.resource});
        if (end < owned.end) left.push_back({owned.heap, end, owned.end, owned.resource});
      }
      left.push_back({p.heap, begin, end, i});
      memory = std::move(left);
    }
    cases[i].replay.run(cases[i].barriers, cases[i].inherited, &findings);
  }
  return cases;
}

std::vector<std::pair<std::string, std::optional<ImageBarrier>>> weakenings(const ImageBarrier& barrier, bool image) {
  std::vector<std::pair<std::string, std::optional<ImageBarrier>>> result;
  result.emplace_back("without it", std::nullopt);
  const auto eachBit = [&](const char* what, auto member) {
    for (uint64_t bit = 1; bit != 0; bit <<= 1) {
      ImageBarrier changed = barrier;
      if ((member(changed) & bit) == 0) continue;
      member(changed) &= ~bit;
      result.emplace_back(std::string("without one bit of its ") + what, changed);
    }
  };
  eachBit("source stages", [](ImageBarrier& b) -> uint64_t& { return b.from.stages; });
  eachBit("source access", [](ImageBarrier& b) -> uint64_t& { return b.from.access; });
  eachBit("target stages", [](ImageBarrier& b) -> uint64_t& { return b.to.stages; });
  eachBit("target access", [](ImageBarrier& b) -> uint64_t& { return b.to.access; });
  if (!image) return result;
  ImageBarrier changed = barrier;
  if (barrier.range.mipCount > 1) {
    --changed.range.mipCount;
    result.emplace_back("without its last mip", changed);
  }
  changed = barrier;
  if (barrier.range.layerCount > 1) {
    --changed.range.layerCount;
    result.emplace_back("without its last layer", changed);
  }
  changed = barrier;
  changed.newLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
  result.emplace_back("with another new layout", changed);
  changed = barrier;
  changed.oldLayout = VK_IMAGE_LAYOUT_UNDEFINED;
  // Without a change of layout the content may be dropped or not; keeping it costs nothing.
  if (barrier.oldLayout != VK_IMAGE_LAYOUT_UNDEFINED && barrier.oldLayout != barrier.newLayout) {
    result.emplace_back("dropping the content", changed);
  }
  return result;
}

}  // namespace

std::vector<Finding> findMissing(const Declaration& declaration, const Plan& plan) {
  std::vector<Finding> findings;
  replayAll(declaration, plan, findings);
  return findings;
}

Superfluous findSuperfluous(const Declaration& declaration, const Plan& plan) {
  Superfluous result;
  std::vector<Finding> ignored;
  std::vector<Case> cases = replayAll(declaration, plan, ignored);
  for (uint32_t resource = 0; resource < cases.size(); ++resource) {
    Case& c = cases[resource];
    for (std::size_t i = 0; i < c.barriers.size(); ++i) {
      for (const auto& [what, changed] : weakenings(c.barriers[i].barrier, declaration.resources[resource].isImage)) {
        std::vector<Placed> barriers = c.barriers;
        if (changed)
          barriers[i].barrier = *changed;
        else
          barriers.erase(barriers.begin() + static_cast<std::ptrdiff_t>(i));
        c.replay.run(barriers, c.inherited, nullptr);
        ++result.attempts;
        if (c.replay.failed()) continue;
        std::ostringstream text;
        text << "barrier on '" << declaration.resources[resource].name << "' before step " << c.barriers[i].step
             << ": nothing is missing " << what;
        result.findings.push_back(text.str());
      }
    }
  }
  return result;
}

}  // namespace plan_checker
