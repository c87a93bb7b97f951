// Replays what a plan does to one resource; the model is described in plan_checker.h.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "plan_checker/plan_checker.h"
#include "plan_checker/plan_order.h"
#include "plan_checker/usage_model.h"

namespace lensgraph::plan_checker {

/// What remains of an earlier use, for the later ones to respect.
struct Record {
  bool write = false;
  bool transition = false;  ///< By a layout transition or transfer: at no stage, always available.
  bool seen = false;        ///< A read has seen it.
  bool inherited = false;   ///< Of another resource in the same memory, or of the frame before.
  uint32_t available = 0;   ///< Queues, one bit each, on which what it wrote is known to be available.
  bool attachment = false;  ///< By an attachment, and nothing else.
  uint32_t pass = 0;
  uint32_t queue = 0, node = 0, time = 0;
  uint32_t rendering = 0;  ///< First step of it.
  StageMask stage = 0;     ///< One bit.
  AccessMask access = 0;
  AccessMask hostVisible = 0;
  uint32_t hostNode = 0;                        ///< Where it became visible to the host.
  std::array<StageMask, kMaxQueues> ordered{};  ///< By queue: the stages that come after it.
  std::array<Touches, kMaxQueues> visible{};
  uint64_t events = 0, eventsWithAccess = 0;  ///< Set after it, and not yet waited for.
  bool operator==(const Record&) const = default;

  static constexpr uint32_t kEverywhere = (1u << kMaxQueues) - 1;
  void makeAvailable(uint32_t queues) { available |= write ? queues : 0; }
  bool availableOn(uint32_t on) const { return (available >> on & 1) != 0; }
};

/// A barrier and where it stands. Buffers' have layouts UNDEFINED.
struct Placed {
  uint32_t step = 0;  ///< For people; number of steps: at the end.
  uint32_t key = 0;
  uint32_t setKey = 0;  ///< Of events: where the first scope ends.
  uint32_t queue = 0, submission = 0;
  rendergraph::ImageBarrier barrier;
};

/// One change to what the plan says.
struct Change {
  uint32_t placed = UINT32_MAX;                        ///< Index of the barrier that is replaced.
  const rendergraph::ImageBarrier* barrier = nullptr;  ///< nullptr: it is left out.
  uint32_t attachment = UINT32_MAX;                    ///< Index of the attachment whose operation is DONT_CARE.
  bool load = false;                                   ///< The load operation, else the store operation.
  bool exclusive = false;                              ///< Not concurrent.
};

class ResourceReplay {
 public:
  ResourceReplay(const Setting& setting, const PlanOrder& order, uint32_t resource, std::vector<Placed> barriers,
                 const std::vector<uint32_t>& accesses, const std::vector<uint32_t>& stepOfPass);

  bool used() const { return !uses_.empty(); }
  uint32_t firstStep() const { return uses_.front().step; }
  uint32_t lastStep() const { return uses_.back().step; }
  uint32_t lastKey() const { return ops_.empty() ? 0 : ops_.back().key; }
  bool concurrent() const { return concurrent_; }
  const std::vector<Placed>& barriers() const { return barriers_; }
  void replaceBarrier(uint32_t index, const Placed& placed);
  /// Attachments whose load (first) or store operation counts here, by index in Plan::attachments.
  std::vector<std::pair<uint32_t, bool>> operations() const;

  /// Runs through one frame; `inherited` are the records of the memory's earlier owners. Without `findings` it stops
  /// at the first fault.
  void run(uint32_t frame, const std::vector<Record>& inherited, std::vector<Finding>* findings,
           const Change& change = {});
  bool failed() const { return failed_; }

  /// Whether every subresource was used, and so has waited for the earlier owners of its memory.
  bool usedThroughout() const;
  /// What later owners of the memory have to respect.
  struct Left {
    std::vector<Record> now;         ///< For those who follow in the frame.
    std::vector<Record> atFrameEnd;  ///< After all waits of the frame, for the next one.
  };
  Left remaining();

 private:
  /// One mip of one layer of one aspect, or a buffer.
  struct Subresource {
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
    VkImageLayout lastUsed = VK_IMAGE_LAYOUT_UNDEFINED;  // Layout of the last use, or before the graph.
    bool hasContent = false;
    bool shouldHaveContent = false;  // If nothing had dropped it.
    bool used = false, touched = false;
    uint32_t owner = UINT32_MAX;                          // Queue family; UINT32_MAX: none yet.
    const rendergraph::ImageBarrier* released = nullptr;  // Between release and acquire.
    std::vector<Record> records;
  };
  struct Operation {  // Of one attachment at one step.
    uint32_t attachment;
    rendergraph::Subresources range;
    bool needsContent, clears, begins, ends;
  };
  struct StepUse {
    uint32_t step = 0, queue = 0, submission = 0;
    std::vector<Use> uses;  // By subresource.
    std::vector<Operation> operations;
  };
  enum class Kind : uint8_t { barrier, set, use };
  struct Op {
    uint32_t key, index;
    Kind kind;
  };

  uint32_t count() const { return static_cast<uint32_t>(aspects_.size()) * mips_ * layers_; }
  template <class F>
  void forEach(const rendergraph::Subresources& range, F&& use) const {
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

  void collectUses(const std::vector<uint32_t>& accesses, const std::vector<uint32_t>& stepOfPass);
  void addUse(uint32_t step, const std::vector<uint32_t>& accesses);
  void addOperations(StepUse& use, const std::vector<uint32_t>& accesses) const;
  void agreeOnLayouts(std::vector<Use>& uses, const std::vector<uint32_t>& accesses) const;
  void collectOps();

  void start(const std::vector<Record>& inherited);
  void addHostRecords(Subresource& subresource) const;
  void addRestRecord(Subresource& subresource) const;
  VkImageLayout restLayout() const;
  uint32_t familyOf(uint32_t queue) const { return setting_.device.queues()[queue].family; }

  void pass(const Wait& milestone);
  void passUntil(uint32_t key);
  std::vector<Record> records() const;
  void apply(const Op& op, const Change& change);
  void setEvent(const Placed& placed, const rendergraph::ImageBarrier& barrier, uint32_t index);
  void applyBarrier(Subresource& subresource, const Placed& placed, const rendergraph::ImageBarrier& barrier,
                    uint32_t index);
  void acquire(Subresource& subresource, const Placed& placed, const rendergraph::ImageBarrier& barrier);
  bool changeOwner(Subresource& subresource, const Placed& placed, const rendergraph::ImageBarrier& barrier);
  void replaceRecords(Subresource& subresource, const Placed& placed, const rendergraph::ImageBarrier& barrier);
  bool inFirstScope(const Record& record, const Placed& placed, StageMask source) const;
  void passOn(Record& record, const Placed& placed, const rendergraph::ImageBarrier& barrier) const;

  void check(const StepUse& use, const Change& change);
  void check(Subresource& subresource, const Use& use, const StepUse& at);
  void checkOwner(Subresource& subresource, const Use& use, const StepUse& at);
  void checkAgainst(Record& record, const Use& use, const StepUse& at, uint32_t node);
  AccessMask visibleTo(const Record& record, uint32_t stage, const StepUse& at, uint32_t node) const;
  void leave(Subresource& subresource, const Use& use, const StepUse& at, uint32_t pass);
  void finish();
  void finish(Subresource& subresource);

  std::string nameOfPass(uint32_t pass) const;
  void fail(Hazard hazard, uint32_t step, const char* why);
  void fail(Hazard hazard, uint32_t step, const char* why, const Record& record);

  const Setting& setting_;
  const PlanOrder& order_;
  uint32_t resource_;
  const rendergraph::DeclaredResource& declared_;
  bool concurrent_ = false;
  uint32_t mips_ = 1, layers_ = 1;
  std::vector<VkImageAspectFlags> aspects_;
  std::vector<StepUse> uses_;
  std::vector<Placed> barriers_;
  std::vector<Op> ops_;

  // Of the run:
  std::vector<Subresource> subresources_;
  std::size_t nextMilestone_ = 0;
  std::vector<Finding>* findings_ = nullptr;
  bool failed_ = false, exclusive_ = true;
  uint32_t frame_ = 0, now_ = 0;
};

}  // namespace lensgraph::plan_checker
