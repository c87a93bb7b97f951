// See the header.
#include "plan_checker/plan_structure.h"

#include <algorithm>
#include <string>

#include "plan_checker/plan_order.h"
#include "plan_checker/usage_model.h"
#include "rendergraph/declare/subresources.h"

namespace lensgraph::plan_checker {

using namespace rendergraph;

namespace {

class Structure {
 public:
  explicit Structure(const Setting& setting)
      : declaration_(setting.declaration),
        plan_(setting.plan),
        options_(setting.options),
        device_(setting.device),
        accesses_(setting.declaration.passes.size()) {
    for (const DeclaredAccess& access : declaration_.accesses) accesses_[access.pass].push_back(&access);
  }

  std::vector<Finding> check() {
    checkRuns();
    if (findings_.empty()) checkSteps();
    if (findings_.empty()) checkSubmissions();
    if (findings_.empty()) checkEvents();
    if (findings_.empty()) checkRenderings();
    if (findings_.empty()) checkBarriers();
    return std::move(findings_);
  }

 private:
  void expect(bool holds, const std::string& what) {
    if (!holds) findings_.push_back({Hazard::structure, what});
  }
  void expectAtStep(bool holds, uint32_t step, const char* what) {
    if (holds) return;
    const uint32_t pass = plan_.passes[step].pass;
    const bool known = pass < declaration_.passes.size();
    expect(false, "step " + std::to_string(step) + " ('" +
                      (known ? std::string(declaration_.passes[pass].name) : std::string("?")) + "'): " + what);
  }

  /// Every element of the plan's arrays belongs to exactly one run.
  class Cover {
   public:
    explicit Cover(std::size_t size) : times_(size, 0) {}
    void add(const Run& run) {
      for (uint32_t i = run.first; i < run.first + run.count; ++i) {
        if (i < times_.size())
          ++times_[i];
        else
          outside_ = true;
      }
    }
    bool once() const {
      return !outside_ && std::all_of(times_.begin(), times_.end(), [](uint32_t n) { return n == 1; });
    }
    bool inside() const { return !outside_; }

   private:
    std::vector<uint32_t> times_;
    bool outside_ = false;
  };

  void checkRuns() {
    Cover images(plan_.imageBarriers.size()), buffers(plan_.bufferBarriers.size()), events(plan_.events.size()),
        sets(plan_.eventSets.size()), waits(plan_.submissionWaits.size()), attachments(plan_.attachments.size());
    uint32_t commands = 0;
    const auto addBatch = [&](const BarrierBatch& batch) {
      images.add(batch.images);
      buffers.add(batch.buffers);
      commands += batch.empty() ? 0 : 1;
    };
    for (const PlannedPass& pass : plan_.passes) {
      addBatch(pass.before);
      events.add(pass.waits);
      sets.add(pass.sets);
      attachments.add(pass.colors);
      attachments.add(pass.depth);
    }
    for (const PlannedSubmission& submission : plan_.submissions) {
      addBatch(submission.atEnd);
      waits.add(submission.waits);
    }
    for (const PlannedEvent& event : plan_.events) {
      expect(!event.barriers.empty(), "an event without barriers");
      addBatch(event.barriers);
    }
    expect(images.once() && buffers.once(), "a barrier belongs to no batch, or to several");
    expect(events.once() && sets.once(), "an event is not waited for once and set once");
    expect(waits.once(), "a submission wait belongs to no submission, or to several");
    expect(attachments.inside(), "an attachment's index is past the end");
    expect(plan_.barrierBatches == commands, "the number of barrier batches is wrong");
  }

  void checkSteps() {
    std::vector<uint32_t> times(declaration_.passes.size(), 0);
    for (uint32_t step = 0; step < plan_.passes.size(); ++step) {
      const PlannedPass& planned = plan_.passes[step];
      expectAtStep(planned.pass < declaration_.passes.size(), step, "no such pass");
      expectAtStep(planned.queue < std::min<std::size_t>(device_.queues().size(), kMaxQueues), step, "no such queue");
      if (!findings_.empty()) return;
      ++times[planned.pass];
      const PassKind kind = declaration_.passes[planned.pass].kind;
      const QueueFacts& queue = device_.queues()[planned.queue];
      expectAtStep(kind != PassKind::raster || queue.graphics, step, "a raster pass on a queue without graphics");
      expectAtStep(kind != PassKind::compute || queue.compute, step, "a compute pass on a queue without compute");
      expectAtStep(options_.useQueues || planned.queue == 0, step, "it is not on the only queue that is asked for");
    }
    for (const CulledPass& culled : plan_.culled) {
      if (culled.pass < times.size()) ++times[culled.pass];
    }
    for (uint32_t pass = 0; pass < times.size(); ++pass) {
      if (declaration_.passes[pass].disabled) ++times[pass];  // As if it had not been declared.
    }
    expect(std::all_of(times.begin(), times.end(), [](uint32_t n) { return n == 1; }),
           "a pass is neither executed nor culled, or more than once");
  }

  void checkSubmissions() {
    uint32_t next = 0, hosts = 0;
    bool several = false;
    for (uint32_t i = 0; i < plan_.submissions.size(); ++i) {
      const PlannedSubmission& submission = plan_.submissions[i];
      expect(submission.steps.count == 0 || submission.steps.first == next, "the submissions' steps are not in order");
      expect(submission.queue < device_.queues().size(), "a submission to no queue");
      if (!findings_.empty() || submission.steps.count > plan_.passes.size() - next) break;
      several = several || submission.queue != 0;
      for (uint32_t step = next; step < next + submission.steps.count; ++step) {
        expectAtStep(plan_.passes[step].queue == submission.queue, step, "its submission goes to another queue");
        if (declaration_.passes[plan_.passes[step].pass].kind != PassKind::host) continue;
        ++hosts;
        expectAtStep(step + 1 == next + submission.steps.count, step, "a host pass does not end its submission");
        expectAtStep(plan_.passes[step].sets.count == 0, step, "a host pass sets events");
      }
      next += submission.steps.count;
      checkWaits(i);
    }
    expect(next == plan_.passes.size(), "the submissions do not execute every step");
    if (plan_.submissions.empty()) return expect(false, "there is no submission");
    expect(several || plan_.submissions.size() == 1 + hosts, "a single queue, and the wrong number of submissions");
    expect(plan_.submissions.front().queue == 0 && plan_.submissions.back().queue == 0,
           "the first and the last submission are not on the first queue");
    if (!findings_.empty() || !several) return;
    expect(PlanOrder(declaration_, plan_, 1).edgesHold(), "the last submission does not wait for all");
  }

  void checkWaits(uint32_t index) {
    const PlannedSubmission& submission = plan_.submissions[index];
    for (const SubmissionWait& wait : plan_.waitsOf(submission)) {
      const std::string which = "submission " + std::to_string(index) + ": ";
      expect(wait.submission < index, which + "it waits for a later one");
      if (wait.submission >= index) continue;
      expect(plan_.submissions[wait.submission].queue != submission.queue, which + "it waits for its own queue");
      expect(wait.stages != 0, which + "it waits at no stage");
      expectStages(wait.stages, submission.queue, which + "its wait");
      expect((wait.stages & VK_PIPELINE_STAGE_2_HOST_BIT) == 0, which + "it waits at the host's stage");
    }
  }

  void expectStages(VkPipelineStageFlags2 stages, uint32_t queue, const std::string& what) {
    if ((stages & VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT) != 0) return;
    expect((stageMask(stages) & ~stagesOf(device_.queues()[queue])) == 0, what + " names a stage that its queue lacks");
  }

  void checkEvents() {
    expect(plan_.events.empty() || options_.splitDistance > 0, "events that nobody asked for");
    for (uint32_t step = 0; step < plan_.passes.size(); ++step) {
      for (const PlannedEvent& event : plan_.waitsOf(plan_.passes[step])) {
        expectAtStep(event.waitBefore == step, step, "it waits for an event of another step");
        expectAtStep(event.setAfter < step, step, "its event is not set before");
        if (event.setAfter >= step) continue;
        expectAtStep(step - event.setAfter > options_.splitDistance, step, "its event is set too shortly before");
        const uint32_t queue = plan_.passes[step].queue;
        expectAtStep(plan_.passes[event.setAfter].queue == queue, step, "its event is set on another queue");
        const QueueFacts& facts = device_.queues()[queue];
        expectAtStep(facts.graphics || facts.compute, step, "an event on a queue that only transfers");
      }
      for (uint32_t event : plan_.setsOf(plan_.passes[step])) {
        const bool same = event < plan_.events.size() && plan_.events[event].setAfter == step;
        expectAtStep(same, step, "it sets an event of another step");
      }
      const bool last = step + 1 == plan_.passes.size() || !plan_.passes[step + 1].continuesRendering;
      expectAtStep(last || plan_.passes[step].sets.count == 0, step, "an event is set within a rendering");
    }
  }

  void checkRenderings() {
    for (uint32_t step = 0; step < plan_.passes.size(); ++step) {
      const PlannedPass& planned = plan_.passes[step];
      const DeclaredPass& declared = declaration_.passes[planned.pass];
      if (declared.kind == PassKind::raster) {
        checkAttachments(step);
        const bool sameArea = planned.renderArea.width == declared.renderArea.width &&
                              planned.renderArea.height == declared.renderArea.height &&
                              planned.renderLayers == declared.renderLayers;
        expectAtStep(sameArea, step, "its render area is not the declared one");
      }
      if (planned.continuesRendering) checkContinuation(step);
    }
  }

  void checkAttachments(uint32_t step) {
    const PlannedPass& planned = plan_.passes[step];
    std::vector<const DeclaredAccess*> colors, depths, resolves;  // The last by colour attachment.
    for (const DeclaredAccess* access : accesses_[planned.pass]) {
      if (access->role == AttachmentRole::color) {
        colors.push_back(access);
        resolves.push_back(nullptr);
      } else if (access->role == AttachmentRole::depth) {
        depths.push_back(access);
      } else if (access->role == AttachmentRole::resolve && !resolves.empty()) {
        resolves.back() = access;
      }
    }
    const auto asDeclared = [&](std::span<const PlannedAttachment> some, const auto& accesses) {
      return std::equal(some.begin(), some.end(), accesses.begin(), accesses.end(), isSame);
    };
    const bool same = asDeclared(plan_.colorsOf(planned), colors) && asDeclared(plan_.depthOf(planned), depths);
    expectAtStep(same, step, "its attachments are not the declared ones");
    if (!same) return;
    for (uint32_t i = 0; i < colors.size(); ++i) checkResolve(step, plan_.colorsOf(planned)[i], resolves[i]);
  }

  static bool isSame(const PlannedAttachment& planned, const DeclaredAccess* declared) {
    return planned.resource == declared->resource && planned.range == declared->range &&
           planned.layout == declared->layout;
  }

  void checkResolve(uint32_t step, const PlannedAttachment& attachment, const DeclaredAccess* declared) {
    if (declared == nullptr) {
      return expectAtStep(attachment.resolve == kNone, step, "nobody asked for this resolve");
    }
    const bool same =
        attachment.resolve < plan_.attachments.size() && isSame(plan_.attachments[attachment.resolve], declared);
    expectAtStep(same, step, "it does not resolve to the declared image");
  }

  void checkContinuation(uint32_t step) {
    if (step == 0) return expectAtStep(false, step, "it continues nothing");
    const PlannedPass &planned = plan_.passes[step], &before = plan_.passes[step - 1];
    const PassKind kind = declaration_.passes[planned.pass].kind, kindBefore = declaration_.passes[before.pass].kind;
    expectAtStep(options_.mergeRasterPasses, step, "it continues a rendering, and nobody asked for it");
    expectAtStep(kind == PassKind::raster && kindBefore == PassKind::raster, step, "it continues no rendering");
    expectAtStep(planned.queue == before.queue, step, "it continues a rendering on another queue");
    for (const PlannedSubmission& submission : plan_.submissions) {
      const bool begins = submission.steps.count > 0 && submission.steps.first == step;
      expectAtStep(!begins, step, "it continues a rendering of another submission");
    }
    expectAtStep(planned.before.empty() && planned.waits.count == 0, step, "it waits within a rendering");
    expectAtStep(planned.renderArea.width == before.renderArea.width &&
                     planned.renderArea.height == before.renderArea.height &&
                     planned.renderLayers == before.renderLayers,
                 step, "it continues a rendering of another size");
    const auto continues = [&](std::span<const PlannedAttachment> some, std::span<const PlannedAttachment> earlier) {
      return std::equal(some.begin(), some.end(), earlier.begin(), earlier.end(),
                        [&](const PlannedAttachment& a, const PlannedAttachment& b) {
                          return a.resource == b.resource && a.range == b.range && a.layout == b.layout &&
                                 a.store == b.store && a.load == VK_ATTACHMENT_LOAD_OP_LOAD && sameResolve(a, b);
                        });
    };
    expectAtStep(continues(plan_.colorsOf(planned), plan_.colorsOf(before)) &&
                     continues(plan_.depthOf(planned), plan_.depthOf(before)),
                 step, "it continues a rendering with other attachments");
    for (const DeclaredAccess* access : accesses_[planned.pass]) {
      const bool clears =
          access->role != AttachmentRole::none && access->load == LoadOp::clear && access->mode == AccessMode::write;
      expectAtStep(!clears, step, "it continues a rendering and clears");
    }
  }

  bool sameResolve(const PlannedAttachment& a, const PlannedAttachment& b) const {
    if (a.resolve == kNone || b.resolve == kNone) {
      return a.resolve == b.resolve;
    }
    const PlannedAttachment &x = plan_.attachments[a.resolve], &y = plan_.attachments[b.resolve];
    return x.resource == y.resource && x.range == y.range && x.layout == y.layout;
  }

  void checkBarriers() {
    for (uint32_t i = 0; i < plan_.submissions.size(); ++i) {
      const PlannedSubmission& submission = plan_.submissions[i];
      for (const PlannedPass& pass : plan_.stepsOf(submission)) {
        checkBatch(pass.before, pass.queue, false, false);
        for (const PlannedEvent& event : plan_.waitsOf(pass)) checkBatch(event.barriers, pass.queue, true, false);
      }
      checkBatch(submission.atEnd, submission.queue, false, true);
    }
  }

  void checkBatch(const BarrierBatch& batch, uint32_t queue, bool event, bool atEnd) {
    for (const ImageBarrier& barrier : plan_.imagesOf(batch)) {
      const DeclaredResource& resource = declaration_.resources[barrier.resource];
      expect(resource.isImage && inside(barrier.range, resource.image) && barrier.range.aspects != 0,
             "a barrier outside the image '" + std::string(resource.name) + "'");
      expect(barrier.newLayout != VK_IMAGE_LAYOUT_UNDEFINED, "a transition to UNDEFINED");
      checkBarrier(barrier, queue, event, atEnd);
    }
    for (const BufferBarrier& barrier : plan_.buffersOf(batch)) {
      expect(!declaration_.resources[barrier.resource].isImage, "a buffer barrier on an image");
      checkBarrier(barrier, queue, event, atEnd);
    }
  }

  template <class Barrier>
  void checkBarrier(const Barrier& barrier, uint32_t queue, bool event, bool atEnd) {
    const std::string which = "barrier on '" + std::string(declaration_.resources[barrier.resource].name) + "'";
    expectStages(barrier.from.stages, queue, which);
    expectStages(barrier.to.stages, queue, which);
    const bool host = ((barrier.from.stages | barrier.to.stages) & VK_PIPELINE_STAGE_2_HOST_BIT) != 0;
    expect(!event || !host, which + ": an event for the host");
    const bool release = barrier.reason == BarrierReason::release, acquire = barrier.reason == BarrierReason::acquire;
    expect((release || acquire) == (barrier.fromQueue != kNone && barrier.toQueue != kNone),
           which + ": its queues do not fit its reason");
    if (!findings_.empty() || (!release && !acquire)) return;
    const auto queues = static_cast<uint32_t>(device_.queues().size());
    expect(barrier.fromQueue < queues && barrier.toQueue < queues, which + ": no such queue");
    if (!findings_.empty()) return;
    expect(device_.queues()[barrier.fromQueue].family != device_.queues()[barrier.toQueue].family,
           which + ": a transfer within one family");
    expect(queue == (release ? barrier.fromQueue : barrier.toQueue), which + ": a transfer on the wrong queue");
    expect(!event, which + ": a transfer by an event");
    expect(!release || atEnd, which + ": a release that is not at the end of a submission");
  }

  const Declaration& declaration_;
  const Plan& plan_;
  const CompileOptions& options_;
  const DeviceFacts& device_;
  std::vector<std::vector<const DeclaredAccess*>> accesses_;  // By pass.
  std::vector<Finding> findings_;
};

}  // namespace

std::vector<Finding> checkStructure(const Setting& setting) {
  return Structure(setting).check();
}

}  // namespace lensgraph::plan_checker
