// Slots and their frames: opened, filled, waited for, given up.
#include "rendergraph/execute/frame/executor_state.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <utility>

#include "rendergraph/compiler.h"
#include "rendergraph/inspect/capture_builder.h"

namespace lensgraph::rendergraph {

ExecutorState::ExecutorState(Backend& device, const ExecutorOptions& chosen)
    : backend(device), options(chosen), persistent(device, deletionQueue), slots(chosen.framesInFlight), frame(device) {
  for (uint32_t i = 0; i < slots.size(); ++i) slots[i].index = i;
}

ExecutorState::~ExecutorState() {
  for (FrameInFlight& slot : slots) {
    if (slot.state != FrameInFlight::State::submitted) continue;
    try {
      waitForDevice(slot, slot.sent);
    } catch (...) {
      // The device is lost: it uses nothing any more.
    }
  }
}

void ExecutorState::makeTimelines() {
  const std::size_t queues = backend.queues().size();
  timelines.reserve(queues);
  while (timelines.size() < queues) {
    const std::string name = "graph queue " + std::to_string(timelines.size());
    timelines.push_back({.semaphore = UniqueTimeline(backend, backend.createTimeline(name)), .value = 0});
  }
}

Jobs& ExecutorState::jobs(uint32_t threadsWanted) {
  if (options.jobs != nullptr) return *options.jobs;
  if (!threads || threads->threads() < threadsWanted) threads = std::make_unique<ThreadPool>(threadsWanted);
  return *threads;
}

// ---- Before a frame

FrameInFlight& ExecutorState::openSlot() {
  FrameInFlight& slot = slots[lastFrame % slots.size()];
  if (slot.state == FrameInFlight::State::submitted) waitFor(slot.frame);
  slot.state = FrameInFlight::State::idle;  // A recorded one has finished: the host has promised it.
  deletionQueue.release(finishedFrame());
  deletionQueue.setLastUser(lastFrame);
  slot.importedViews.clear();
  slot.exports.serial = 0;
  slot.sent.clear();
  slot.stamped.clear();
  for (const UniqueRecorder& recorder : slot.recorders) {
    if (recorder) backend.resetRecorder(recorder.get());
  }
  return slot;
}

uint64_t ExecutorState::finishedFrame() const {
  uint64_t finished = lastFrame;
  for (const FrameInFlight& slot : slots) {
    if (slot.state != FrameInFlight::State::idle) finished = std::min(finished, slot.frame - 1);
  }
  return finished;
}

void ExecutorState::makeResources(const Declaration& declaration, uint32_t slot) {
  plans.releaseResources(PlanCache::kWithResources);
  const auto slotCount = static_cast<uint32_t>(slots.size());
  if (!current->resources) current->resources = std::make_unique<PlanResources>(slotCount);
  try {
    current->resources->prepare(backend, pool, declaration, current->plan, slot);
  } catch (const GraphError& error) {
    if (error.misuse() == Misuse::deviceLost) throw;
    // The other plans' objects may be what fills the memory; without them it gets one more chance.
    plans.releaseResources(1);
    waitForAll();
    deletionQueue.release(finishedFrame());
    try {
      current->resources->prepare(backend, pool, declaration, current->plan, slot);
    } catch (const GraphError&) {
      throw error;  // The first one names what did not fit when more was there.
    }
  }
}

void ExecutorState::prepare(const Declaration& declared, const CompileOptions& compileOptions, FrameInFlight& slot,
                            Timing timing) {
  // Problems with handles leave no trace in the structure, so an equal structure does not excuse them.
  if (!declared.problems.empty()) throw GraphError(declared.problems);
  current = nullptr;
  const uint64_t hash = structuralHash(declared, compileOptions);
  CachedPlan* found = plans.find(hash);
  slot.capture.planReused = found != nullptr;
  if (found != nullptr) {
    ++reused;
  } else {
    found = &plans.add(hash, compile(declared, compileOptions, backend));
    ++compiled;
  }
  current = found;
  frame.declaration = &declared;
  frame.plan = &found->plan;
  frame.capture = &slot.capture;
  frame.start = slot.start;
  beginCapture(slot.capture, declared, found->plan, timing);
  frame.objects.assign(declared.resources.size(), {});
  for (uint32_t index = 0; index < declared.resources.size(); ++index) {
    const DeclaredResource& resource = declared.resources[index];
    if (!resource.imported()) continue;
    frame.objects[index] = {
        .image = resource.importedImage, .buffer = resource.importedBuffer, .views = &slot.importedViews};
  }
  makeResources(declared, slot.index);
  current->resources->bind(current->plan, slot.index, frame.objects);
  frame.events = current->resources->events(slot.index);
  persistent.prepare(declared, current->plan, frame.objects);
  frame.timestamps = VK_NULL_HANDLE;
  if (timing == Timing::inlineTimestamps) openTimestamps(slot);
}

void ExecutorState::openTimestamps(FrameInFlight& slot) {
  constexpr uint32_t kMaxSteps = 4096;  // Later passes stay unmeasured.
  const auto steps = std::min(kMaxSteps, static_cast<uint32_t>(frame.plan->passes.size()));
  if (slot.timestampSteps < steps) {
    const std::string name = "graph frame " + std::to_string(slot.index) + ", timestamps";
    slot.timestamps = UniqueTimestamps(backend, backend.createTimestamps(2 * steps, name));
    slot.timestampSteps = steps;
  }
  if (steps > 0) backend.resetTimestamps(slot.timestamps.get(), 2 * steps);
  frame.timestamps = slot.timestamps.get();
  frame.timestampSteps = steps;
  for (uint32_t step = 0; step < steps; ++step) {
    if (frame.isStamped(step)) slot.stamped.push_back(step);
  }
}

// ---- After it

void ExecutorState::closeSlot(FrameInFlight& slot, FrameInFlight::State state) {
  persistent.commit();
  slot.frame = ++lastFrame;
  slot.state = state;
  lastHash = current->hash;
  frame.declaration = nullptr;
  deletionQueue.setLastUser(lastFrame);
}

void ExecutorState::abandon(FrameInFlight& slot) noexcept {
  frame.declaration = nullptr;
  slot.exports.serial = 0;
  slot.importedViews.clear();
  if (slot.sent.empty()) return;
  lastHash = 0;
  persistent.invalidate();
  try {
    waitForDevice(slot, slot.sent);
    slot.sent.clear();
  } catch (...) {
    // The error that ended the frame is the one to report. The device may still be at work: the next call waits again.
    slot.frame = ++lastFrame;
    slot.state = FrameInFlight::State::submitted;
    slot.stamped.clear();
    deletionQueue.setLastUser(lastFrame);
  }
}

void ExecutorState::waitFor(uint64_t frameNumber) {
  for (;;) {
    FrameInFlight* oldest = nullptr;
    for (FrameInFlight& slot : slots) {
      if (slot.state != FrameInFlight::State::submitted || slot.frame > frameNumber) continue;
      if (oldest == nullptr || slot.frame < oldest->frame) oldest = &slot;
    }
    if (oldest == nullptr) return;
    finish(*oldest);
  }
}

void ExecutorState::finish(FrameInFlight& slot) {
  waitForDevice(slot, slot.sent);
  slot.state = FrameInFlight::State::idle;
  slot.importedViews.clear();
  deletionQueue.release(finishedFrame());
  readStamps(slot);
  slot.capture.frameWallMs = millisecondsSince(slot.start);
  std::swap(capture, slot.capture);
}

void ExecutorState::readStamps(FrameInFlight& slot) {
  if (slot.stamped.empty()) return;
  const double tickMs = backend.nanosecondsPerTick() * 1e-6;
  const auto between = [&](uint64_t from, uint64_t to) {  // Differences of ticks: a double keeps the nanoseconds.
    return static_cast<double>(static_cast<int64_t>(to - from)) * tickMs;
  };
  double& frameMs = slot.capture.frameGpuMs;
  frameMs = 0.0;
  auto next = slot.stamped.begin();
  for (const SentSubmission& sent : slot.sent) {
    // The device's clock has its own origin: a submission's first timestamp stands for when it was given to the device.
    uint64_t first = 0;
    double submissionMs = 0.0;
    bool hasFirst = false;
    for (; next != slot.stamped.end() && sent.hasSteps && *next <= sent.lastStep; ++next) {
      std::array<uint64_t, 2> ticks{};
      backend.readTimestamps(slot.timestamps.get(), 2 * *next, ticks);
      if (!std::exchange(hasFirst, true)) first = ticks[0];
      CapturedPass& pass = slot.capture.passes[*next];
      pass.gpuMs = between(ticks[0], ticks[1]);
      pass.gpuStartMs = sent.sentMs + between(first, ticks[0]);
      submissionMs = std::max(submissionMs, between(first, ticks[1]));
    }
    frameMs += submissionMs;
  }
}

const SentSubmission* ExecutorState::unfinished(const FrameInFlight& slot) const {
  for (const SentSubmission& sent : slot.sent) {
    try {
      if (backend.timelineValue(timelines[sent.queue].semaphore.get()) < sent.value) return &sent;
    } catch (const GraphError&) {
      return nullptr;  // Not even that can be known.
    }
  }
  return nullptr;
}

void ExecutorState::waitForDevice(const FrameInFlight& slot, std::span<const SentSubmission> sent) {
  if (sent.empty()) return;
  waitedSemaphores.assign(timelines.size(), VK_NULL_HANDLE);
  waitedValues.assign(timelines.size(), 0);
  for (std::size_t i = 0; i < timelines.size(); ++i) waitedSemaphores[i] = timelines[i].semaphore.get();
  for (const SentSubmission& one : sent) waitedValues[one.queue] = std::max(waitedValues[one.queue], one.value);
  VkSemaphoreWaitInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO;
  info.semaphoreCount = static_cast<uint32_t>(waitedSemaphores.size());
  info.pSemaphores = waitedSemaphores.data();
  info.pValues = waitedValues.data();
  try {
    backend.waitTimelines(info);
  } catch (const GraphError& error) {
    // Nobody knows what of the frames was carried out.
    lastHash = 0;
    persistent.invalidateAll();
    const SentSubmission* stopped = unfinished(slot);
    if (stopped == nullptr && !slot.sent.empty()) stopped = &slot.sent.back();
    std::vector<GraphError::Problem> problems = error.problems();
    if (stopped != nullptr && stopped->hasSteps && problems.front().pass.empty()) {
      const std::string& first = slot.capture.passes[stopped->firstStep].name;
      const std::string& last = slot.capture.passes[stopped->lastStep].name;
      problems.front().pass = first;
      if (stopped->firstStep != stopped->lastStep) {
        problems.front().reason += ", between the passes '" + first + "' and '" + last + "'";
      }
    }
    throw GraphError(std::move(problems));
  }
}

void ExecutorState::forget() {
  current = nullptr;
  lastHash = 0;
  for (FrameInFlight& slot : slots) {
    slot.exports = {};
    slot.importedViews.clear();
  }
  persistent.clear();
  plans.clear();
  deletionQueue.release(std::numeric_limits<uint64_t>::max());
}

}  // namespace lensgraph::rendergraph
