// The public face of ExecutorState: calls with their preconditions checked, and look-ups of what a frame exported.
#include "rendergraph/executor.h"

#include <string>

#include "rendergraph/execute/frame/executor_state.h"

namespace lensgraph::rendergraph {

namespace {

[[noreturn]] void refuse(Misuse misuse, const char* reason, const char* remedy) {
  throw GraphError({{.misuse = misuse, .pass = {}, .resource = {}, .reason = reason, .remedy = remedy, .where = {}}});
}

/// The frame in flight that served the latest frame of the handle's declaration.
template <class Tag>
const FrameInFlight& exporterOf(const FrameRing& frames, const Handle<Tag>& handle) {
  if (!handle) {
    refuse(Misuse::unknownHandle, "the handle was never given a resource", "use a handle that the graph returned");
  }
  const FrameInFlight* latest = nullptr;
  for (const FrameInFlight& frame : frames.all()) {
    const bool isIts = frame.exports.serial == handle.graph && handle.resource < frame.exports.objects.size();
    if (isIts && (latest == nullptr || frame.frame > latest->frame)) latest = &frame;
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

}  // namespace

Executor::Executor(Backend& backend, const ExecutorOptions& options) {
  if (options.framesInFlight < 1 || options.framesInFlight > 4) {
    refuse(Misuse::overLimit, "the number of frames in flight is not 1 … 4", "2 or 3 keep a device busy");
  }
  state_ = std::make_unique<ExecutorState>(backend, options);
}
Executor::~Executor() = default;

FrameToken Executor::submit(const Graph& graph, const ExecuteOptions& options) {
  return {state_->submit(graph.declaration(), options)};
}

void Executor::wait(FrameToken frame) {
  state_->waitFor(frame.number);
}

bool Executor::isFinished(FrameToken frame) const {
  return state_->isFinished(frame.number);
}

void Executor::execute(const Graph& graph, const ExecuteOptions& options) {
  wait(submit(graph, options));
}

void Executor::record(const Graph& graph, VkCommandBuffer commands, const ExecuteOptions& options) {
  state_->record(graph.declaration(), commands, options.compile);
}

const Plan& Executor::plan() const {
  static const Plan kEmpty;
  const Plan* current = state_->plans().current();
  return current != nullptr ? *current : kEmpty;
}

const Capture& Executor::capture() const {
  return state_->capture();
}

VkImage Executor::exportedImage(Image image) const {
  return exporterOf(state_->frames(), image).exports.objects[image.resource].image;
}

VkBuffer Executor::exportedBuffer(Buffer buffer) const {
  return exporterOf(state_->frames(), buffer).exports.objects[buffer.resource].buffer;
}

std::span<const std::byte> Executor::mapped(Buffer buffer) const {
  const FrameInFlight& frame = exporterOf(state_->frames(), buffer);
  if (frame.state == FrameInFlight::State::submitted) {
    refuse(Misuse::unfinishedFrame, "the frame that fills the buffer was not waited for", "call wait() before");
  }
  const std::byte* address = frame.exports.objects[buffer.resource].address;
  if (address == nullptr) return {};
  return {address, static_cast<std::size_t>(frame.exports.sizes[buffer.resource])};
}

uint64_t Executor::plansCompiled() const {
  return state_->plans().compiled();
}
uint64_t Executor::plansReused() const {
  return state_->plans().reused();
}

void Executor::clear() {
  state_->clear();
}

}  // namespace lensgraph::rendergraph
