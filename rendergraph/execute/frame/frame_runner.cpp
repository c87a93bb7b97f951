// One execution, submission by submission. The submissions up to the next host pass make a segment: its steps are cut
// into chunks, one command buffer each, which several threads record; then the segment's submissions go to their
// queues in order.
#include "rendergraph/execute/frame/frame_runner.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <exception>
#include <string>

#include "rendergraph/declare/declaration.h"
#include "rendergraph/error.h"

namespace lensgraph::rendergraph {

namespace {

constexpr uint32_t kMaxThreads = 64;  // Beyond this, further lanes only add command buffers.

}  // namespace

FrameRunner::FrameRunner(Backend& backend, const ExecutorOptions& options, RecordingContext& context,
                         QueueTimelines& timelines, PlanStore& plans)
    : backend_(backend),
      severalInFlight_(options.framesInFlight > 1),
      hostJobs_(options.jobs),
      context_(context),
      timelines_(timelines),
      plans_(plans) {}

Jobs& FrameRunner::jobs() {
  if (hostJobs_ != nullptr) return *hostJobs_;
  if (!pool_ || pool_->threads() < threads_) pool_ = std::make_unique<ThreadPool>(threads_);
  return *pool_;
}

// ---- What stands before everything else

bool FrameRunner::needsStart() const {
  return (severalInFlight_ && plans_.followsAnotherPlan()) || plans_.persistent().needsStart();
}

void FrameRunner::recordStart(const CommandStream& commands) {
  if (!needsStart()) return;
  backend_.beginLabel(commands, "frame start");
  if (severalInFlight_) {
    // Another plan's frame may still be under way in the same memory; the plan only waits for a frame of its own kind.
    // Its first barriers chain to this one because, with overlappingFrames, they name stages: NONE would not chain.
    VkMemoryBarrier2 everything{};
    everything.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2;
    everything.srcStageMask = everything.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    everything.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
    everything.dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
    VkDependencyInfo dependency{};
    dependency.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
    dependency.memoryBarrierCount = 1;
    dependency.pMemoryBarriers = &everything;
    backend_.barrier(commands, dependency);
  }
  plans_.persistent().recordStart(commands);
  backend_.endLabel(commands);
}

// ---- Cutting

bool FrameRunner::endsWithHostPass(uint32_t submission) const {
  const std::span<const PlannedPass> steps = plan().stepsOf(plan().submissions[submission]);
  return !steps.empty() && context_.declared(steps.back()).kind == PassKind::host;
}

uint32_t FrameRunner::deviceSteps(uint32_t submission) const {
  return plan().submissions[submission].steps.count - (endsWithHostPass(submission) ? 1 : 0);
}

void FrameRunner::cutSubmission(uint32_t submission, uint32_t& position, uint32_t total, uint32_t lanes) {
  const Plan& plan = this->plan();
  const bool isolated = timing_ == Timing::isolated;
  const uint32_t firstStep = plan.submissions[submission].steps.first;
  uint32_t lane = chunks_.empty() ? 0 : chunks_.back().lane;
  const auto begin = [&](uint32_t step) {
    chunks_.push_back({.submission = submission, .firstStep = step, .steps = 0, .lane = lane, .commands = {}});
  };
  begin(firstStep);
  chunks_.back().starts = submission == 0;
  for (uint32_t step = firstStep; step < firstStep + deviceSteps(submission); ++step, ++position) {
    const auto due = static_cast<uint32_t>(uint64_t{position} * lanes / total);
    const bool moves = due != lane && !plan.passes[step].continuesRendering;
    if (moves) lane = due;
    // Isolated, what begins and what ends the frame has a chunk of its own, so that no pass is charged for it.
    if (moves || isolated) {
      if (chunks_.back().steps == 0 && !chunks_.back().starts) {
        chunks_.back().lane = lane;
      } else {
        begin(step);
      }
    }
    ++chunks_.back().steps;
  }
  if (isolated) begin(firstStep + deviceSteps(submission));
  chunks_.back().ends = true;
}

void FrameRunner::cutChunks(uint32_t first, uint32_t last) {
  chunks_.clear();
  uint32_t total = 0, position = 0;
  for (uint32_t submission = first; submission <= last; ++submission) total += deviceSteps(submission);
  const bool parallel = timing_ != Timing::isolated;
  const uint32_t lanes = parallel ? std::clamp(std::min(threads_, total), 1u, kMaxThreads) : 1;
  for (uint32_t submission = first; submission <= last; ++submission) {
    cutSubmission(submission, position, total, lanes);
  }
}

// ---- Recording

UniqueRecorder& FrameRunner::recorder(uint32_t lane, uint32_t queue) {
  return frame_->recorders[lane * backend_.queues().size() + queue];
}

/// Everything the lanes need is made here, on one thread.
void FrameRunner::openLanes() {
  const std::size_t queues = backend_.queues().size();
  const uint32_t lanes = chunks_.empty() ? 0 : chunks_.back().lane + 1;
  while (lanes_.size() < lanes) lanes_.push_back(std::make_unique<StepRecorder>(context_));
  if (frame_->recorders.size() < lanes * queues) frame_->recorders.resize(lanes * queues);
  for (const Chunk& chunk : chunks_) {
    const uint32_t queue = plan().submissions[chunk.submission].queue;
    UniqueRecorder& owned = recorder(chunk.lane, queue);
    if (owned) continue;
    const std::string name = "graph frame " + std::to_string(frame_->index) + ", recording " +
                             std::to_string(chunk.lane) + ", queue " + std::to_string(queue);
    owned = UniqueRecorder(backend_, backend_.createRecorder(queue, name));
  }
}

void FrameRunner::recordChunk(Chunk& chunk) {
  const PlannedSubmission& submission = plan().submissions[chunk.submission];
  const bool waits = chunk.ends && endsWithHostPass(chunk.submission);
  const PlannedPass* host = waits ? &plan().stepsOf(submission).back() : nullptr;
  const bool starts = chunk.starts && needsStart();
  const bool hostWaits = host != nullptr && (!host->before.empty() || host->waits.count > 0);
  if (chunk.steps == 0 && !starts && !hostWaits && !(chunk.ends && !submission.atEnd.empty())) return;
  StepRecorder& lane = *lanes_[chunk.lane];
  const CommandStream commands = backend_.beginCommands(recorder(chunk.lane, submission.queue).get());
  lane.setCommands(commands);
  if (starts) recordStart(commands);
  for (uint32_t step = chunk.firstStep; step < chunk.firstStep + chunk.steps; ++step) lane.recordStep(step);
  if (hostWaits) lane.recordHostWait(submission.steps.first + submission.steps.count - 1);
  if (chunk.ends) lane.recordBarriers(submission.atEnd);
  backend_.endCommands(commands);
  chunk.commands = commands;
}

void FrameRunner::recordLane(uint32_t lane) {
  for (Chunk& chunk : chunks_) {
    if (chunk.lane == lane) recordChunk(chunk);
  }
}

void FrameRunner::recordSegment(uint32_t first, uint32_t last) {
  cutChunks(first, last);
  openLanes();
  const uint32_t lanes = chunks_.back().lane + 1;
  if (lanes == 1) {
    recordLane(0);
    return;
  }
  std::atomic<uint32_t> failed{lanes};  // The lowest lane that threw: with one thread, nothing after it would run.
  std::array<std::exception_ptr, kMaxThreads> errors;
  auto record = [&](uint32_t lane) {
    if (failed.load() < lane) return;
    try {
      recordLane(lane);
    } catch (...) {
      errors[lane] = std::current_exception();
      uint32_t lowest = failed.load();
      while (lane < lowest && !failed.compare_exchange_weak(lowest, lane)) {
      }
    }
  };
  jobs().run(lanes, Job::of(record));
  if (failed.load() < lanes) std::rethrow_exception(errors[failed.load()]);
}

// ---- Submission

void FrameRunner::submit(uint32_t submission, std::span<const Chunk> chunks) {
  const PlannedSubmission& planned = plan().submissions[submission];
  buffers_.clear();
  for (const Chunk& chunk : chunks) {
    if (chunk.commands.buffer == VK_NULL_HANDLE) continue;
    VkCommandBufferSubmitInfo& buffer = buffers_.emplace_back();
    buffer = {};
    buffer.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO;
    buffer.commandBuffer = chunk.commands.buffer;
  }
  waits_.clear();
  for (const SubmissionWait& wait : plan().waitsOf(planned)) {
    VkSemaphoreSubmitInfo& info = waits_.emplace_back();
    info = {};
    info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO;
    info.semaphore = timelines_.semaphore(plan().submissions[wait.submission].queue);
    info.value = reachedValues_[wait.submission];
    info.stageMask = wait.stages;
  }
  reachedValues_[submission] = timelines_.value(planned.queue);
  if (buffers_.empty() && waits_.empty()) return;  // Whoever waits for it waits for what lies before it.
  VkSubmitInfo2 info{};
  info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2;
  info.waitSemaphoreInfoCount = static_cast<uint32_t>(waits_.size());
  info.pWaitSemaphoreInfos = waits_.data();
  info.commandBufferInfoCount = static_cast<uint32_t>(buffers_.size());
  info.pCommandBufferInfos = buffers_.data();
  SentSubmission sent{.submission = submission, .queue = planned.queue, .sentMs = millisecondsSince(frame_->start)};
  for (const Chunk& chunk : chunks) {
    if (chunk.steps == 0) continue;
    if (!sent.hasSteps) sent.firstStep = chunk.firstStep;
    sent.lastStep = chunk.firstStep + chunk.steps - 1;
    sent.hasSteps = true;
  }
  frame_->sent.reserve(frame_->sent.size() + 1);  // So that nothing throws once the device has it.
  sent.value = timelines_.submit(planned.queue, info);
  frame_->sent.push_back(sent);
  reachedValues_[submission] = sent.value;
}

void FrameRunner::waitForSubmission(uint32_t submission) {
  const auto sent = std::find_if(frame_->sent.rbegin(), frame_->sent.rend(),
                                 [&](const SentSubmission& one) { return one.submission == submission; });
  if (sent != frame_->sent.rend()) timelines_.wait(*frame_, {&*sent, 1});  // Else the device had nothing to do.
}

/// Isolated timing: every chunk alone on the device, timed by the host.
void FrameRunner::submitMeasured(uint32_t submission, std::span<const Chunk> chunks) {
  for (const Chunk& chunk : chunks) {
    const double startMs = millisecondsSince(frame_->start);
    submit(submission, {&chunk, 1});
    waitForSubmission(submission);
    if (chunk.steps == 0) continue;
    CapturedPass& pass = frame_->capture.passes[chunk.firstStep];
    pass.gpuStartMs = startMs;
    pass.gpuMs = millisecondsSince(frame_->start) - startMs;
  }
}

void FrameRunner::submitSegment(uint32_t first, uint32_t last) {
  const double startMs = millisecondsSince(frame_->start);
  std::span<const Chunk> rest(chunks_);
  for (uint32_t submission = first; submission <= last; ++submission) {
    const auto end = std::ranges::find_if(rest, [&](const Chunk& chunk) { return chunk.submission != submission; });
    const auto chunks = rest.first(static_cast<std::size_t>(end - rest.begin()));
    rest = rest.subspan(chunks.size());
    timing_ == Timing::isolated ? submitMeasured(submission, chunks) : submit(submission, chunks);
  }
  if (timing_ != Timing::isolated) return;
  // A clock of its own, so that the passes' times can be held against it.
  double& frameMs = frame_->capture.frameGpuMs;
  frameMs = std::max(0.0, frameMs) + millisecondsSince(frame_->start) - startMs;
}

void FrameRunner::begin(FrameInFlight& frame, Timing timing, uint32_t threads) {
  frame_ = &frame;
  timing_ = timing;
  threads_ = threads;
}

void FrameRunner::execute(FrameInFlight& frame, Timing timing, uint32_t threads) {
  begin(frame, timing, threads);
  const auto submissions = static_cast<uint32_t>(plan().submissions.size());
  timelines_.open();
  reachedValues_.assign(submissions, 0);
  uint32_t last = 0;
  for (uint32_t first = 0; first < submissions; first = last + 1) {
    last = first;
    while (last + 1 < submissions && !endsWithHostPass(last)) ++last;
    recordSegment(first, last);
    submitSegment(first, last);
    if (!endsWithHostPass(last)) continue;
    waitForSubmission(last);
    const Run& steps = plan().submissions[last].steps;
    lanes_.front()->runHostPass(steps.first + steps.count - 1);
  }
}

void FrameRunner::refuseHostPasses() const {
  for (const PlannedPass& planned : plan().passes) {
    const DeclaredPass& pass = context_.declared(planned);
    if (pass.kind != PassKind::host) continue;
    throw GraphError({context_.declaration->problem(Misuse::undeclaredAccess, planned.pass, kNone,
                                                    "a host pass cannot run inside the host's own submission",
                                                    "use execute(), or do its work before or after", pass.where)});
  }
}

void FrameRunner::record(FrameInFlight& frame, VkCommandBuffer commands) {
  begin(frame, Timing::none, 1);
  refuseHostPasses();
  chunks_.assign(1, {.commands = {}});
  openLanes();
  const CommandStream stream{commands, recorder(0, 0).get()};
  lanes_.front()->setCommands(stream);
  recordStart(stream);
  for (uint32_t step = 0; step < plan().passes.size(); ++step) lanes_.front()->recordStep(step);
  lanes_.front()->recordBarriers(plan().submissions.back().atEnd);
}

}  // namespace lensgraph::rendergraph
