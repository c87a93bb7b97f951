// Cells that several queues use. Semaphores order the queues, make every write available and visible to the stages
// that wait (Vulkan 1.3, 7.4.2 and 7.6.4), so between queues a barrier is needed for two things only:
//   a new layout      by the queue that used the cell last, at the end of its submission, when several queues read
//                     the cell next; else by the queue that uses it next, chained to the stages that waited;
//   a new owner       released at the end of the last submission of the old owner's queue that uses it, and acquired
//                     before the first use by the new one; both name the layouts.
// On the queue that goes on using the cell itself, the rules of barrier_planner.cpp hold. Every barrier is proposed in full;
// what semaphores have seen to is taken from it afterwards (barrier_trimming.h).
#include <algorithm>

#include "rendergraph/compile/sync/barrier_planner.h"
#include "rendergraph/declare/access_table.h"

namespace lensgraph::rendergraph {

namespace {

bool has(const Epoch& epoch, uint32_t queue) {
  return std::any_of(epoch.uses.begin(), epoch.uses.end(), [&](const CellUse& use) { return use.queue == queue; });
}

/// One of the stages of a queue that have waited for the semaphore when an epoch begins: enough to chain to it.
VkPipelineStageFlags2 waitingStage(const Epoch& epoch, uint32_t queue) {
  const VkPipelineStageFlags2 stages = semaphoreStages(partOf(epoch, queue).stages);
  return firstBitOf(stages);
}

}  // namespace

/// A cell that changes queues, between two epochs.
struct BarrierPlanner::Crossing {
  struct OnQueue {
    bool used = false;  // By the last epoch.
    AccessPoint last;   // Its part of it.
  };
  uint32_t resource, cell;
  Sharing sharing;
  VkImageLayout layout;
  bool hasContent;  // Somebody has written it, or it came from outside.
  bool wrote;
  bool alias;
  uint32_t lastStep;   // kNone: before the graph.
  uint32_t lastQueue;  // Of lastStep.
  std::vector<OnQueue> queues;

  bool onOneQueue() const {
    return std::count_if(queues.begin(), queues.end(), [](const OnQueue& queue) { return queue.used; }) == 1;
  }
};

bool BarrierPlanner::crosses(const DeclaredResource& resource) const {
  const uint32_t home = resource.created() ? uses_.front().queue : 0;
  return std::any_of(uses_.begin(), uses_.end(), [&](const CellUse& use) { return use.queue != home; });
}

void BarrierPlanner::planCrossingCell(uint32_t resource, uint32_t cell, const CellState& start) {
  const DeclaredResource& declared = in_.declaration.resources[resource];
  const uint32_t home = declared.created() ? uses_.front().queue : 0;
  Crossing crossing{.resource = resource,
                    .cell = cell,
                    .sharing = in_.sharing[resource],
                    .layout = start.layout,
                    .hasContent = !declared.created(),
                    .wrote = start.wrote,
                    .alias = start.alias,
                    .lastStep = kNone,
                    .lastQueue = home,
                    .queues = std::vector<Crossing::OnQueue>(in_.schedule.queues)};
  crossing.queues[home] = {.used = true, .last = start.last};
  for (std::size_t first = 0; first < uses_.size();) {
    const Epoch epoch = epochAt(uses_, first, hasOwner(crossing.sharing));
    const std::size_t before = found_.size();
    cross(crossing, epoch);
    trimming_->trim(epoch, found_, before);
    first += epoch.uses.size();
  }
}

void BarrierPlanner::cross(Crossing& crossing, const Epoch& epoch) {
  const bool isImage = in_.declaration.resources[crossing.resource].isImage;
  const bool otherFamily = hasOwner(crossing.sharing) && crossing.hasContent &&
                           in_.queues[epoch.uses.front().queue].family != in_.queues[crossing.lastQueue].family;
  const bool newOwner = otherFamily && epoch.needsContent();
  // An image whose content is dropped changes hands by a transition from UNDEFINED.
  const bool transition = isImage && (crossing.layout != epoch.layout() || otherFamily);
  const bool atEnd = transition && crossing.onOneQueue() && epoch.onSeveralQueues();
  std::vector<Crossing::OnQueue> after(in_.schedule.queues);
  for (uint32_t queue = 0; queue < in_.schedule.queues; ++queue) {
    if (!has(epoch, queue)) continue;
    const Epoch part = partOf(epoch, queue);
    after[queue].used = true;
    after[queue].last = {.pass = epoch.uses.back().lastPass,
                         .stages = part.stages,
                         .access = epoch.writes() ? part.access & kWriteAccess : 0};
  }
  if (newOwner) {
    transferOwnership(crossing, epoch);
  } else if (atEnd) {
    changeLayoutAtEnd(crossing, epoch);
  } else if (transition) {
    changeLayoutBefore(crossing, epoch);
  } else if (epoch.stages != 0) {
    for (uint32_t queue = 0; queue < in_.schedule.queues; ++queue) {
      if (!has(epoch, queue)) continue;
      if (crossing.queues[queue].used) {
        waitOnOwnQueue(crossing, epoch, queue);
      } else {
        chainFromWait(crossing, epoch, queue);
      }
    }
  }
  crossing.queues = std::move(after);
  crossing.layout = epoch.layout();
  crossing.hasContent = true;
  crossing.wrote = epoch.writes();
  crossing.alias = false;
  crossing.lastStep = epoch.uses.back().step;
  crossing.lastQueue = epoch.uses.back().queue;
}

uint32_t BarrierPlanner::submissionAfter(const Crossing& crossing) const {
  return crossing.lastStep == kNone ? 0 : in_.submissions.of[in_.schedule.unitLast[crossing.lastStep]];
}

void BarrierPlanner::transferOwnership(Crossing& crossing, const Epoch& epoch) {
  const uint32_t queue = epoch.uses.front().queue;
  AccessPoint from = crossing.queues[crossing.lastQueue].last;
  // An empty scope means the previous frame's closing barrier already covers this resource; chain to that barrier.
  if (from.stages == 0 && in_.options.overlappingFrames) from.stages = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  ImageBarrier release{.from = from,
                       .to = {.pass = epoch.uses.front().pass},
                       .oldLayout = crossing.layout,
                       .newLayout = epoch.layout(),
                       .fromQueue = crossing.lastQueue,
                       .toQueue = queue,
                       .reason = BarrierReason::release};
  release.resource = crossing.resource;
  release.range = in_.cells.rangeOf(crossing.resource, crossing.cell);
  found_.push_back({.step = in_.schedule.steps(), .submission = submissionAfter(crossing), .barrier = release});

  ImageBarrier acquire = release;
  acquire.from = {.pass = from.pass, .stages = waitingStage(epoch, queue)};
  acquire.to = {.pass = epoch.uses.front().pass, .stages = epoch.stages, .access = epoch.access};
  acquire.reason = BarrierReason::acquire;
  addCrossing(crossing, epoch, queue, acquire);
}

void BarrierPlanner::changeLayoutAtEnd(Crossing& crossing, const Epoch& epoch) {
  AccessPoint from = crossing.queues[crossing.lastQueue].last;
  if (from.stages == 0 && in_.options.overlappingFrames) from.stages = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  const Epoch part = partOf(epoch, crossing.lastQueue);  // The others learn of it by semaphores.
  ImageBarrier barrier{.from = from,
                       .to = {.pass = epoch.uses.front().pass, .stages = part.stages, .access = part.access},
                       .oldLayout = crossing.layout,
                       .newLayout = epoch.layout(),
                       .reason = BarrierReason::layout};
  barrier.resource = crossing.resource;
  barrier.range = in_.cells.rangeOf(crossing.resource, crossing.cell);
  const uint32_t submission = submissionAfter(crossing);
  for (const CellUse& use : epoch.uses) {
    // The same submission goes on with the new layout; the others wait for its end in any case.
    const bool sameSubmission =
        crossing.lastStep != kNone && use.step < in_.schedule.steps() && in_.submissions.of[use.step] == submission;
    if (sameSubmission) return addCrossing(crossing, epoch, use.queue, barrier);
  }
  found_.push_back({.step = in_.schedule.steps(), .submission = submission, .barrier = barrier});
}

void BarrierPlanner::changeLayoutBefore(Crossing& crossing, const Epoch& epoch) {
  const uint32_t queue = epoch.uses.front().queue;
  const Crossing::OnQueue& own = crossing.queues[queue];
  AccessPoint from;
  bool elsewhere = false;
  for (uint32_t other = 0; other < in_.schedule.queues; ++other) {
    if (!crossing.queues[other].used) continue;
    elsewhere = elsewhere || other != queue;
    from.pass = crossing.queues[other].last.pass;
  }
  if (own.used) from = own.last;
  if (elsewhere && (from.stages & partOf(epoch, queue).stages) == 0) from.stages |= waitingStage(epoch, queue);
  const bool kept = in_.declaration.resources[crossing.resource].persistent() && crossing.lastStep == kNone;
  if (from.stages == 0 && kept && in_.options.overlappingFrames) from.stages = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  const Epoch part = partOf(epoch, queue);
  const bool dropped = epoch.writes() && !epoch.needsContent();
  addCrossing(crossing, epoch, queue,
              {.from = from,
               .to = {.pass = epoch.uses.front().pass, .stages = part.stages, .access = part.access},
               .oldLayout = dropped ? VK_IMAGE_LAYOUT_UNDEFINED : crossing.layout,
               .newLayout = epoch.layout(),
               .reason = crossing.alias ? BarrierReason::alias : BarrierReason::layout});
}

/// The queue was among those that used the cell last, and goes on in the same layout.
void BarrierPlanner::waitOnOwnQueue(Crossing& crossing, const Epoch& epoch, uint32_t queue) {
  const Crossing::OnQueue& own = crossing.queues[queue];
  const Epoch part = partOf(epoch, queue);
  if (own.last.stages == 0) return;
  // What the host wrote is visible to itself, and to all that is submitted later.
  if (crossing.wrote && own.last.stages == VK_PIPELINE_STAGE_2_HOST_BIT) return;
  AccessPoint from = own.last;
  // What all stages wait for, none has waited for elsewhere.
  const bool chains = (part.stages & VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT) != 0 && !crossing.onOneQueue();
  if (chains) from.stages |= waitingStage(epoch, queue);
  ImageBarrier barrier{.from = from,
                       .to = {.stages = part.stages, .access = part.access},
                       .oldLayout = crossing.layout,
                       .newLayout = epoch.layout()};
  if (crossing.wrote) {
    barrier.reason = epoch.needsContent() ? BarrierReason::readAfterWrite : BarrierReason::writeAfterWrite;
  } else if (epoch.writes()) {
    barrier.reason = BarrierReason::writeAfterRead;
    barrier.to.access = epoch.needsContent() ? part.access & ~kWriteAccess : VkAccessFlags2{0};
  } else {
    barrier.reason = BarrierReason::readAfterWrite;
  }
  if (crossing.alias) barrier.reason = BarrierReason::alias;
  addCrossing(crossing, epoch, queue, barrier);
}

/// No semaphore reaches the host's own stage, and none need reach all stages.
void BarrierPlanner::chainFromWait(Crossing& crossing, const Epoch& epoch, uint32_t queue) {
  const Epoch part = partOf(epoch, queue);
  const VkPipelineStageFlags2 stages =
      part.stages & (VK_PIPELINE_STAGE_2_HOST_BIT | VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT);
  if (stages == 0 || !(epoch.needsContent() || crossing.wrote)) return;
  addCrossing(crossing, epoch, queue,
              {.from = {.pass = crossing.queues[crossing.lastQueue].last.pass, .stages = waitingStage(epoch, queue)},
               .to = {.stages = stages, .access = part.access},
               .oldLayout = crossing.layout,
               .newLayout = epoch.layout(),
               .reason = BarrierReason::readAfterWrite});
}

/// Before the epoch's first use on a queue. It stays there: earlier, the queue might not have waited yet.
void BarrierPlanner::addCrossing(const Crossing& crossing, const Epoch& epoch, uint32_t queue, ImageBarrier barrier) {
  const auto use = std::find_if(epoch.uses.begin(), epoch.uses.end(),
                                [&](const CellUse& candidate) { return candidate.queue == queue; });
  barrier.resource = crossing.resource;
  barrier.range = in_.cells.rangeOf(crossing.resource, crossing.cell);
  barrier.to.pass = use->pass;
  found_.push_back({.step = use->step, .earliest = use->step, .barrier = barrier});
}

}  // namespace lensgraph::rendergraph
