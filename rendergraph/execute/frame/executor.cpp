// The public face: one execution from declaration to results, and the questions one may ask afterwards.
#include "rendergraph/executor.h"

#include <string>

#include "rendergraph/execute/frame/executor_state.h"
#include "rendergraph/execute/frame/frame_runner.h"
#include "rendergraph/inspect/capture_builder.h"

namespace lensgraph::rendergraph {

void ExportTable::take(const Declaration& declaration, const ResourceTable& table) {
  serial = declaration.serial;
  objects = table;
  exported.clear();
  sizes.clear();
  for (const DeclaredResource& resource : declaration.resources) {
    exported.push_back(resource.exported);
    sizes.push_back(resource.isImage ? 0 : resource.buffer.size);
  }
}

namespace {

[[noreturn]] void refuse(Misuse misuse, const char* reason, const char* remedy) {
  throw GraphError({{.misuse = misuse, .pass = {}, .resource = {}, .reason = reason, .remedy = remedy, .where = {}}});
}

/// The slot of the latest frame that this graph gave.
template <class Tag>
const FrameInFlight& exporterOf(const std::vector<FrameInFlight>& slots, const Handle<Tag>& handle) {
  if (!handle) {
    refuse(Misuse::unknownHandle, "the handle was never given a resource", "use a handle that the graph returned");
  }
  const FrameInFlight* latest = nullptr;
  for (const FrameInFlight& slot : slots) {
    const bool isIts = slot.exports.serial == handle.graph && handle.resource < slot.exports.objects.size();
    if (isIts && (latest == nullptr || slot.frame > latest->frame)) latest = &slot;
  }
  if (latest == nullptr) {
    refuse(Misuse::foreignHandle, "the handle does not belong to a graph executed lately",
           "look exports up before the executions that replace them (ExecutorOptions::framesInFlight)");
  }
  if (!latest->exports.exported[handle.resource]) {
    refuse(Misuse::importState, "the resource was not exported", "call exportImage() or exportBuffer() on it");
  }
  return *latest;
}

CompileOptions compileOptionsOf(const ExecuteOptions& options, std::size_t framesInFlight) {
  CompileOptions compile = options.compile;
  if (framesInFlight > 1) compile.overlappingFrames = true;
  if (options.timing != Timing::isolated) return compile;
  compile.mergeRasterPasses = false;  // What is to be timed alone stands alone.
  compile.splitDistance = 0;
  compile.useQueues = false;
  return compile;
}

}  // namespace

Executor::Executor(Backend& backend, const ExecutorOptions& options) {
  if (options.framesInFlight < 1 || options.framesInFlight > 4) {
    refuse(Misuse::overLimit, "the number of frames in flight is not 1 … 4", "2 or 3 keep a device busy");
  }
  state_ = std::make_unique<ExecutorState>(backend, options);
}
Executor::~Executor() = default;

FrameToken Executor::submit(const Graph& graph, const ExecuteOptions& options) {
  const Clock::time_point start = Clock::now();
  const Declaration& declaration = graph.declaration();
  if (options.timing == Timing::isolated) state_->waitForAll();
  FrameInFlight& slot = state_->openSlot();
  slot.start = start;
  try {
    state_->prepare(declaration, compileOptionsOf(options, state_->slots.size()), slot, options.timing);
    FrameRunner(*state_, slot, options.timing, options.recordingThreads).execute();
    slot.exports.take(declaration, state_->frame.objects);
  } catch (...) {
    state_->abandon(slot);
    throw;
  }
  state_->closeSlot(slot, FrameInFlight::State::submitted);
  return {slot.frame};
}

void Executor::wait(FrameToken frame) {
  state_->waitFor(frame.number);
}

bool Executor::isFinished(FrameToken frame) const {
  for (const FrameInFlight& slot : state_->slots) {
    if (slot.state != FrameInFlight::State::submitted || slot.frame > frame.number) continue;
    for (const SentSubmission& sent : slot.sent) {
      const VkSemaphore timeline = state_->timelines[sent.queue].semaphore.get();
      if (state_->backend.timelineValue(timeline) < sent.value) return false;
    }
  }
  return true;
}

void Executor::execute(const Graph& graph, const ExecuteOptions& options) {
  wait(submit(graph, options));
}

void Executor::record(const Graph& graph, VkCommandBuffer commands, const ExecuteOptions& options) {
  const Declaration& declaration = graph.declaration();
  FrameInFlight& slot = state_->openSlot();
  slot.start = Clock::now();
  CompileOptions compile = compileOptionsOf({.compile = options.compile}, state_->slots.size());
  compile.useQueues = false;
  try {
    state_->prepare(declaration, compile, slot, Timing::none);
    FrameRunner(*state_, slot, Timing::none, 1).record(commands);
    slot.exports.take(declaration, state_->frame.objects);
  } catch (...) {
    state_->abandon(slot);
    throw;
  }
  slot.capture.frameWallMs = millisecondsSince(slot.start);
  std::swap(state_->capture, slot.capture);
  state_->closeSlot(slot, FrameInFlight::State::recorded);
}

const Plan& Executor::plan() const {
  static const Plan kEmpty;
  return state_->current != nullptr ? state_->current->plan : kEmpty;
}

const Capture& Executor::capture() const {
  return state_->capture;
}

VkImage Executor::exportedImage(Image image) const {
  return exporterOf(state_->slots, image).exports.objects[image.resource].image;
}

VkBuffer Executor::exportedBuffer(Buffer buffer) const {
  return exporterOf(state_->slots, buffer).exports.objects[buffer.resource].buffer;
}

std::span<const std::byte> Executor::mapped(Buffer buffer) const {
  const FrameInFlight& slot = exporterOf(state_->slots, buffer);
  if (slot.state == FrameInFlight::State::submitted) {
    refuse(Misuse::unfinishedFrame, "the frame that fills the buffer was not waited for", "call wait() before");
  }
  const ResourceObjects& bound = slot.exports.objects[buffer.resource];
  if (bound.address == nullptr) return {};
  return {bound.address, static_cast<std::size_t>(slot.exports.sizes[buffer.resource])};
}

uint64_t Executor::plansCompiled() const {
  return state_->compiled;
}
uint64_t Executor::plansReused() const {
  return state_->reused;
}

void Executor::clear() {
  state_->waitForAll();
  state_->forget();
}

}  // namespace lensgraph::rendergraph
