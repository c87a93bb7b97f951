// Opens a frame in flight, prepares plan and objects, has the runner record and submit, and closes the frame; waits for
// frames and takes their times.
#include "rendergraph/execute/frame/executor_state.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "rendergraph/declare/declaration.h"
#include "rendergraph/inspect/capture_builder.h"

namespace lensgraph::rendergraph {

namespace {

CompileOptions compileOptionsOf(const ExecuteOptions& options) {
  CompileOptions compile = options.compile;
  if (options.timing != Timing::isolated) return compile;
  compile.mergeRasterPasses = false;  // Every pass gets a rendering of its own, so that it can be timed alone.
  compile.splitDistance = 0;
  compile.useQueues = false;
  return compile;
}

}  // namespace

ExecutorState::ExecutorState(Backend& backend, const ExecutorOptions& options)
    : backend_(backend),
      plans_(backend, options.framesInFlight),
      timelines_(backend, plans_),
      frames_(options.framesInFlight),
      context_(backend),
      runner_(backend, options, context_, timelines_, plans_) {}

ExecutorState::~ExecutorState() {
  for (const FrameInFlight& frame : frames_.all()) {
    if (frame.state != FrameInFlight::State::submitted) continue;
    try {
      timelines_.wait(frame, frame.sent);
    } catch (...) {
      // The device is lost: it uses nothing any more.
    }
  }
}

// ---- One frame

template <class Run>
uint64_t ExecutorState::runFrame(const Declaration& declaration, const CompileOptions& options, Timing timing,
                                 FrameInFlight::State state, Run&& run) {
  const Clock::time_point start = Clock::now();
  if (timing == Timing::isolated) waitForAll();
  FrameInFlight& frame = openFrame();
  // A frame that the host submits begins when it is recorded; waiting for the previous one is the host's affair.
  frame.start = state == FrameInFlight::State::recorded ? Clock::now() : start;
  try {
    CompileOptions compile = options;
    if (frames_.size() > 1) compile.overlappingFrames = true;
    prepare(declaration, compile, frame, timing);
    run(frame);
    frame.exports.take(declaration, context_.objects);
  } catch (...) {
    abandon(frame);
    throw;
  }
  context_.declaration = nullptr;
  frames_.close(frame, state);
  plans_.commit(frames_.lastFrame());
  return frame.frame;
}

uint64_t ExecutorState::submit(const Declaration& declaration, const ExecuteOptions& options) {
  return runFrame(declaration, compileOptionsOf(options), options.timing, FrameInFlight::State::submitted,
                  [&](FrameInFlight& frame) { runner_.execute(frame, options.timing, options.recordingThreads); });
}

void ExecutorState::record(const Declaration& declaration, VkCommandBuffer commands, const CompileOptions& options) {
  CompileOptions oneQueue = options;
  oneQueue.useQueues = false;
  runFrame(declaration, oneQueue, Timing::none, FrameInFlight::State::recorded, [&](FrameInFlight& frame) {
    runner_.record(frame, commands);
    frame.capture.frameWallMs = millisecondsSince(frame.start);
    std::swap(capture_, frame.capture);
  });
}

/// The frame in flight that serves the next frame; waits for the frame that it served last.
FrameInFlight& ExecutorState::openFrame() {
  FrameInFlight& frame = frames_.next();
  if (frame.state == FrameInFlight::State::submitted) waitFor(frame.frame);
  frame.state = FrameInFlight::State::idle;  // A recorded one has finished: the host has promised it.
  plans_.release(frames_.finishedFrame());
  plans_.setLastUser(frames_.lastFrame());
  frame.importedViews.clear();
  frame.exports.serial = 0;
  frame.sent.clear();
  frame.stamped.clear();
  for (const UniqueRecorder& recorder : frame.recorders) {
    if (recorder) backend_.resetRecorder(recorder.get());
  }
  return frame;
}

void ExecutorState::prepare(const Declaration& declaration, const CompileOptions& options, FrameInFlight& frame,
                            Timing timing) {
  frame.capture.planReused = plans_.select(declaration, options);
  context_.declaration = &declaration;
  context_.plan = plans_.current();
  context_.capture = &frame.capture;
  context_.start = frame.start;
  beginCapture(frame.capture, declaration, *plans_.current(), timing);
  context_.objects.assign(declaration.resources.size(), {});
  for (uint32_t index = 0; index < declaration.resources.size(); ++index) {
    const DeclaredResource& resource = declaration.resources[index];
    if (!resource.imported()) continue;
    context_.objects[index] = {
        .image = resource.importedImage, .buffer = resource.importedBuffer, .views = &frame.importedViews};
  }
  makeObjects(declaration, frame);
  plans_.enterInto(context_.objects, declaration, frame.index);
  context_.events = plans_.events(frame.index);
  context_.timestamps = VK_NULL_HANDLE;
  if (timing == Timing::inlineTimestamps) openTimestamps(frame);
}

void ExecutorState::makeObjects(const Declaration& declaration, FrameInFlight& frame) {
  try {
    plans_.makeObjects(declaration, frame.index);
  } catch (const GraphError& error) {
    if (error.misuse() == Misuse::deviceLost) throw;
    // The other plans' objects may be what fills the memory; without them it gets one more chance.
    plans_.giveUpOthers();
    waitForAll();
    plans_.release(frames_.finishedFrame());
    try {
      plans_.makeObjects(declaration, frame.index);
    } catch (const GraphError&) {
      throw error;  // The first one names what did not fit when more was there.
    }
  }
}

void ExecutorState::openTimestamps(FrameInFlight& frame) {
  constexpr uint32_t kMaxSteps = 4096;  // Later passes stay unmeasured.
  const auto steps = std::min(kMaxSteps, static_cast<uint32_t>(context_.plan->passes.size()));
  if (frame.timestampSteps < steps) {
    const std::string name = "graph frame " + std::to_string(frame.index) + ", timestamps";
    frame.timestamps = UniqueTimestamps(backend_, backend_.createTimestamps(2 * steps, name));
    frame.timestampSteps = steps;
  }
  if (steps > 0) backend_.resetTimestamps(frame.timestamps.get(), 2 * steps);
  context_.timestamps = frame.timestamps.get();
  context_.timestampSteps = steps;
  for (uint32_t step = 0; step < steps; ++step) {
    if (context_.isStamped(step)) frame.stamped.push_back(step);
  }
}

void ExecutorState::abandon(FrameInFlight& frame) noexcept {
  context_.declaration = nullptr;
  frame.exports.serial = 0;
  if (frame.sent.empty()) {
    frame.importedViews.clear();
    return;
  }
  plans_.abandon();
  try {
    timelines_.wait(frame, frame.sent);
    frame.sent.clear();
    frame.importedViews.clear();  // Not before: what was submitted may use the views.
  } catch (...) {
    // The error that ended the frame is the one to report. The device may still be at work: the next call waits again.
    frames_.close(frame, FrameInFlight::State::submitted);
    frame.stamped.clear();
    plans_.setLastUser(frames_.lastFrame());
  }
}

// ---- After it

void ExecutorState::waitFor(uint64_t number) {
  while (FrameInFlight* oldest = frames_.oldestUnfinished(number)) finish(*oldest);
}

bool ExecutorState::isFinished(uint64_t number) const {
  return std::ranges::all_of(frames_.all(), [&](const FrameInFlight& frame) {
    if (frame.state != FrameInFlight::State::submitted || frame.frame > number) return true;
    return std::ranges::all_of(frame.sent, [&](const SentSubmission& sent) { return timelines_.isFinished(sent); });
  });
}

void ExecutorState::finish(FrameInFlight& frame) {
  timelines_.wait(frame, frame.sent);
  frame.state = FrameInFlight::State::idle;
  frame.importedViews.clear();
  plans_.release(frames_.finishedFrame());
  readTimestamps(frame);
  frame.capture.frameWallMs = millisecondsSince(frame.start);
  std::swap(capture_, frame.capture);
}

void ExecutorState::readTimestamps(FrameInFlight& frame) {
  if (frame.stamped.empty()) return;
  const double tickMs = backend_.nanosecondsPerTick() * 1e-6;
  const auto between = [&](uint64_t from, uint64_t to) {  // Differences of ticks: a double keeps the nanoseconds.
    return static_cast<double>(static_cast<int64_t>(to - from)) * tickMs;
  };
  double& frameMs = frame.capture.frameGpuMs;
  frameMs = 0.0;
  auto next = frame.stamped.begin();
  for (const SentSubmission& sent : frame.sent) {
    // The device's clock has its own origin: a submission's first timestamp stands for when it was given to the device.
    uint64_t first = 0;
    double submissionMs = 0.0;
    bool hasFirst = false;
    for (; next != frame.stamped.end() && sent.hasSteps && *next <= sent.lastStep; ++next) {
      std::array<uint64_t, 2> ticks{};
      backend_.readTimestamps(frame.timestamps.get(), 2 * *next, ticks);
      if (!std::exchange(hasFirst, true)) first = ticks[0];
      CapturedPass& pass = frame.capture.passes[*next];
      pass.gpuMs = between(ticks[0], ticks[1]);
      pass.gpuStartMs = sent.sentMs + between(first, ticks[0]);
      submissionMs = std::max(submissionMs, between(first, ticks[1]));
    }
    frameMs += submissionMs;
  }
}

void ExecutorState::clear() {
  waitForAll();
  for (FrameInFlight& frame : frames_.all()) {
    frame.exports = {};
    frame.importedViews.clear();
  }
  plans_.clear();
}

}  // namespace lensgraph::rendergraph
