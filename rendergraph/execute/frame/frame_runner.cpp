// One execution, submission by submission. The submissions up to the next host pass make a segment: its steps are cut
// into chunks, one command buffer each, which several threads record; then the segment's submissions go to their
// queues in order.
#include "rendergraph/execute/frame/frame_runner.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <exception>
#include <string>

#include "rendergraph/pass.h"

namespace lensgraph::rendergraph {

namespace {

constexpr uint32_t kMaxThreads = 64;  // More lanes than that only cost command buffers.

}  // namespace

// ---- What stands before everything else

bool FrameRunner::needsStart() const {
  const bool others = state_.slots.size() > 1 && state_.lastFrame > 0 && state_.lastHash != state_.current->hash;
  return others || state_.persistent.needsStart();
}

void FrameRunner::recordStart(const CommandStream& commands) {
  if (!needsStart()) return;
  state_.backend.beginLabel(commands, "frame start");
  if (state_.slots.size() > 1) {
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
    state_.backend.barrier(commands, dependency);
  }
  state_.persistent.recordStart(commands);
  state_.backend.endLabel(commands);
}

// ---- Cutting

bool FrameRunner::endsWithHostPass(uint32_t submission) const {
  const std::span<const PlannedPass> steps = state_.current->plan.stepsOf(state_.current->plan.submissions[submission]);
  return !steps.empty() && state_.frame.declared(steps.back()).kind == PassKind::host;
}

uint32_t FrameRunner::deviceSteps(uint32_t submission) const {
  return state_.current->plan.submissions[submission].steps.count - (endsWithHostPass(submission) ? 1 : 0);
}

void FrameRunner::cutSubmission(uint32_t submission, uint32_t& position, uint32_t total, uint32_t lanes) {
  const Plan& plan = state_.current->plan;
  std::vector<Chunk>& chunks = state_.chunks;
  const bool isolated = timing_ == Timing::isolated;
  const uint32_t firstStep = plan.submissions[submission].steps.first;
  uint32_t lane = chunks.empty() ? 0 : chunks.back().lane;
  const auto begin = [&](uint32_t step) {
    chunks.push_back({.submission = submission, .firstStep = step, .steps = 0, .lane = lane, .commands = {}});
  };
  begin(firstStep);
  chunks.back().starts = submission == 0;
  for (uint32_t step = firstStep; step < firstStep + deviceSteps(submission); ++step, ++position) {
    const auto due = static_cast<uint32_t>(uint64_t{position} * lanes / total);
    const bool moves = due != lane && !plan.passes[step].continuesRendering;
    if (moves) lane = due;
    // Isolated, what begins and what ends the frame has a chunk of its own, so that no pass is charged for it.
    if (moves || isolated) {
      if (chunks.back().steps == 0 && !chunks.back().starts) {
        chunks.back().lane = lane;
      } else {
        begin(step);
      }
    }
    ++chunks.back().steps;
  }
  if (isolated) begin(firstStep + deviceSteps(submission));
  chunks.back().ends = true;
}

void FrameRunner::cutChunks(uint32_t first, uint32_t last) {
  state_.chunks.clear();
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
  return slot_.recorders[lane * state_.backend.queues().size() + queue];
}

/// Everything the lanes need is made here, on one thread.
void FrameRunner::openLanes() {
  const std::size_t queues = state_.backend.queues().size();
  const uint32_t lanes = state_.chunks.empty() ? 0 : state_.chunks.back().lane + 1;
  while (state_.lanes.size() < lanes) state_.lanes.push_back(std::make_unique<StepRecorder>(state_.frame));
  if (slot_.recorders.size() < lanes * queues) slot_.recorders.resize(lanes * queues);
  for (const Chunk& chunk : state_.chunks) {
    const uint32_t queue = state_.current->plan.submissions[chunk.submission].queue;
    UniqueRecorder& owned = recorder(chunk.lane, queue);
    if (owned) continue;
    const std::string name = "graph frame " + std::to_string(slot_.index) + ", recording " +
                             std::to_string(chunk.lane) + ", queue " + std::to_string(queue);
    owned = UniqueRecorder(state_.backend, state_.backend.createRecorder(queue, name));
  }
}

void FrameRunner::recordChunk(Chunk& chunk) {
  const PlannedSubmission& submission = state_.current->plan.submissions[chunk.submission];
  const bool waits = chunk.ends && endsWithHostPass(chunk.submission);
  const PlannedPass* host = waits ? &state_.current->plan.stepsOf(submission).back() : nullptr;
  const bool starts = chunk.starts && needsStart();
  const bool hostWaits = host != nullptr && (!host->before.empty() || host->waits.count > 0);
  if (chunk.steps == 0 && !starts && !hostWaits && !(chunk.ends && !submission.atEnd.empty())) return;
  StepRecorder& lane = *state_.lanes[chunk.lane];
  const CommandStream commands = state_.backend.beginCommands(recorder(chunk.lane, submission.queue).get());
  lane.setCommands(commands);
  if (starts) recordStart(commands);
  for (uint32_t step = chunk.firstStep; step < chunk.firstStep + chunk.steps; ++step) lane.recordStep(step);
  if (hostWaits) lane.recordHostWait(submission.steps.first + submission.steps.count - 1);
  if (chunk.ends) lane.recordBarriers(submission.atEnd);
  state_.backend.endCommands(commands);
  chunk.commands = commands;
}

void FrameRunner::recordLane(uint32_t lane) {
  for (Chunk& chunk : state_.chunks) {
    if (chunk.lane == lane) recordChunk(chunk);
  }
}

void FrameRunner::recordSegment(uint32_t first, uint32_t last) {
  cutChunks(first, last);
  openLanes();
  const uint32_t lanes = state_.chunks.back().lane + 1;
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
  state_.jobs(threads_).run(lanes, Job::of(record));
  if (failed.load() < lanes) std::rethrow_exception(errors[failed.load()]);
}

// ---- Submission

void FrameRunner::submit(uint32_t submission, std::span<const Chunk> chunks) {
  const PlannedSubmission& planned = state_.current->plan.submissions[submission];
  QueueTimeline& timeline = state_.timelines[planned.queue];
  state_.buffers.clear();
  for (const Chunk& chunk : chunks) {
    if (chunk.commands.buffer == VK_NULL_HANDLE) continue;
    VkCommandBufferSubmitInfo& buffer = state_.buffers.emplace_back();
    buffer = {};
    buffer.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO;
    buffer.commandBuffer = chunk.commands.buffer;
  }
  state_.waits.clear();
  for (const SubmissionWait& wait : state_.current->plan.waitsOf(planned)) {
    VkSemaphoreSubmitInfo& info = state_.waits.emplace_back();
    info = {};
    info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO;
    info.semaphore = state_.timelines[state_.current->plan.submissions[wait.submission].queue].semaphore.get();
    info.value = state_.values[wait.submission];
    info.stageMask = wait.stages;
  }
  state_.values[submission] = timeline.value;
  if (state_.buffers.empty() && state_.waits.empty()) return;  // Whoever waits for it waits for what lies before it.
  VkSemaphoreSubmitInfo signal{};
  signal.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO;
  signal.semaphore = timeline.semaphore.get();
  signal.value = timeline.value + 1;
  signal.stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  VkSubmitInfo2 info{};
  info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2;
  info.waitSemaphoreInfoCount = static_cast<uint32_t>(state_.waits.size());
  info.pWaitSemaphoreInfos = state_.waits.data();
  info.commandBufferInfoCount = static_cast<uint32_t>(state_.buffers.size());
  info.pCommandBufferInfos = state_.buffers.data();
  info.signalSemaphoreInfoCount = 1;
  info.pSignalSemaphoreInfos = &signal;
  SentSubmission sent{.submission = submission,
                      .queue = planned.queue,
                      .value = signal.value,
                      .sentMs = millisecondsSince(slot_.start)};
  for (const Chunk& chunk : chunks) {
    if (chunk.steps == 0) continue;
    if (!sent.hasSteps) sent.firstStep = chunk.firstStep;
    sent.lastStep = chunk.firstStep + chunk.steps - 1;
    sent.hasSteps = true;
  }
  slot_.sent.reserve(slot_.sent.size() + 1);  // So that nothing throws once the device has it.
  state_.backend.submit(planned.queue, info);
  slot_.sent.push_back(sent);
  state_.values[submission] = timeline.value = signal.value;
}

void FrameRunner::waitForSubmission(uint32_t submission) {
  const auto sent = std::find_if(slot_.sent.rbegin(), slot_.sent.rend(),
                                 [&](const SentSubmission& one) { return one.submission == submission; });
  if (sent != slot_.sent.rend()) state_.waitForDevice(slot_, {&*sent, 1});  // Else the device had nothing to do.
}

/// Isolated timing: every chunk alone on the device, timed by the host.
void FrameRunner::submitMeasured(uint32_t submission, std::span<const Chunk> chunks) {
  for (const Chunk& chunk : chunks) {
    const double startMs = millisecondsSince(slot_.start);
    submit(submission, {&chunk, 1});
    waitForSubmission(submission);
    if (chunk.steps == 0) continue;
    CapturedPass& pass = slot_.capture.passes[chunk.firstStep];
    pass.gpuStartMs = startMs;
    pass.gpuMs = millisecondsSince(slot_.start) - startMs;
  }
}

void FrameRunner::submitSegment(uint32_t first, uint32_t last) {
  const double startMs = millisecondsSince(slot_.start);
  std::span<const Chunk> rest(state_.chunks);
  for (uint32_t submission = first; submission <= last; ++submission) {
    const auto end = std::ranges::find_if(rest, [&](const Chunk& chunk) { return chunk.submission != submission; });
    const auto chunks = rest.first(static_cast<std::size_t>(end - rest.begin()));
    rest = rest.subspan(chunks.size());
    timing_ == Timing::isolated ? submitMeasured(submission, chunks) : submit(submission, chunks);
  }
  if (timing_ != Timing::isolated) return;
  // A clock of its own, so that the passes' times can be held against it.
  double& frameMs = slot_.capture.frameGpuMs;
  frameMs = std::max(0.0, frameMs) + millisecondsSince(slot_.start) - startMs;
}

void FrameRunner::execute() {
  const Plan& plan = state_.current->plan;
  const auto submissions = static_cast<uint32_t>(plan.submissions.size());
  state_.makeTimelines();
  state_.values.assign(submissions, 0);
  uint32_t last = 0;
  for (uint32_t first = 0; first < submissions; first = last + 1) {
    last = first;
    while (last + 1 < submissions && !endsWithHostPass(last)) ++last;
    recordSegment(first, last);
    submitSegment(first, last);
    if (!endsWithHostPass(last)) continue;
    waitForSubmission(last);
    const Run& steps = plan.submissions[last].steps;
    state_.lanes.front()->runHostPass(steps.first + steps.count - 1);
  }
}

void FrameRunner::refuseHostPasses() const {
  for (const PlannedPass& planned : state_.current->plan.passes) {
    const DeclaredPass& pass = state_.frame.declared(planned);
    if (pass.kind != PassKind::host) continue;
    throw GraphError({state_.frame.declaration->problem(Misuse::undeclaredAccess, planned.pass, kNone,
                                                        "a host pass cannot run inside the host's own submission",
                                                        "use execute(), or do its work before or after", pass.where)});
  }
}

void FrameRunner::record(VkCommandBuffer commands) {
  refuseHostPasses();
  const Plan& plan = state_.current->plan;
  state_.chunks.assign(1, {.commands = {}});
  openLanes();
  const CommandStream stream{commands, recorder(0, 0).get()};
  state_.lanes.front()->setCommands(stream);
  recordStart(stream);
  for (uint32_t step = 0; step < plan.passes.size(); ++step) state_.lanes.front()->recordStep(step);
  state_.lanes.front()->recordBarriers(plan.submissions.back().atEnd);
}

}  // namespace lensgraph::rendergraph
