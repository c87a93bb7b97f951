// Carries out a declaration on a backend: compiles (or finds the plan of an equal structure), makes the resources,
// records every pass with its barriers, submits, and keeps what lives across frames.
//
//   Executor executor(backend, {.framesInFlight = 2});
//   for (;;) {
//     graph.reset();
//     const Buffer result = declare(graph);       // While the device works on the frames before.
//     const FrameToken frame = executor.submit(graph);
//     …
//     executor.wait(frame);                        // When the host needs what it left.
//     use(executor.mapped(result));
//   }
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "rendergraph/backend.h"
#include "rendergraph/capture.h"
#include "rendergraph/execute_options.h"
#include "rendergraph/graph.h"
#include "rendergraph/plan.h"

namespace lensgraph::rendergraph {

class ExecutorState;

/// A frame given to the device; numbers count up from 1, 0 is none.
struct FrameToken {
  uint64_t number = 0;
  bool operator==(const FrameToken&) const = default;
};

/// One executor serves one device and any number of declarations, one call at a time; not thread-safe.
/// Precondition: the backend outlives the executor.
///
/// Errors. Every call that declares, records, submits or waits throws GraphError, and whatever a recording throws (with
/// several recording threads: the exception of the pass that comes first, after all threads have stopped). The executor
/// stays usable: nothing was submitted when the declaration or a recording is at fault, except that host passes and
/// isolated timing have had what lies before them submitted; then, and when a submission or a wait fails, persistent
/// content that the frame uses is zeroed again. After Misuse::deviceLost every call fails until device, backend and
/// executor are made anew; its text names the passes between which the device stopped. Misuse::outOfMemory leaves room
/// for something smaller.
class Executor {
 public:
  /// Throws GraphError (overLimit) for other numbers of frames in flight.
  explicit Executor(Backend& backend, const ExecutorOptions& options = {});
  /// Waits for all submitted frames.
  ~Executor();
  Executor(const Executor&) = delete;
  Executor& operator=(const Executor&) = delete;

  /// submit() and wait().
  void execute(const Graph& graph, const ExecuteOptions& options = {});

  /// Records and submits the graph. Waits only for the frame that lies ExecutorOptions::framesInFlight calls back, and
  /// where a host pass follows the device's work, for that work; isolated timing waits throughout. The graph may be
  /// reset when it returns. The device carries out frames in order: a frame finds what the frame before left in
  /// persistent and history resources, and overwrites the exported images of the frame before.
  FrameToken submit(const Graph& graph, const ExecuteOptions& options = {});
  /// Waits until the device has finished the frame and all before it, and takes its times. Returns at once for a frame
  /// that was waited for. Precondition: the token is of this executor, or 0.
  void wait(FrameToken frame);
  /// Whether wait() would return without waiting. Does not take the frame's times.
  bool isFinished(FrameToken frame) const;

  /// Records the graph into the host's command buffer, which is in the recording state on the first of the backend's
  /// queues; the host submits it, in the order of the calls and on that queue. Everything it uses stays as it is until
  /// framesInFlight calls later (of record() or submit()) or the executor's end: before these the host makes sure that
  /// its submission has finished. With one frame in flight, therefore, it waits before the next call; with more, its
  /// frames may overlap. Takes no times; a graph with host passes is refused (undeclaredAccess), since the host's
  /// submission cannot be interrupted.
  void record(const Graph& graph, VkCommandBuffer commands, const ExecuteOptions& options = {});

  /// Of the latest frame that was submitted or recorded. Valid until the next one.
  const Plan& plan() const;
  /// Of the frame that was waited for last (its times included) or recorded last.
  const Capture& capture() const;
  /// The Vulkan objects of resources that a graph exported in its latest frame; until framesInFlight calls later.
  VkImage exportedImage(Image image) const;
  VkBuffer exportedBuffer(Buffer buffer) const;
  /// Host-visible content of an exported readback (or upload) buffer; until framesInFlight calls later. Throws
  /// GraphError (unfinishedFrame) before the frame was waited for.
  std::span<const std::byte> mapped(Buffer buffer) const;

  /// Plans compiled so far, against executions that found theirs: an unchanged frame adds to the second only.
  uint64_t plansCompiled() const;
  uint64_t plansReused() const;

  /// Waits for all frames, then destroys all resources and plans; persistent content is lost.
  void clear();

 private:
  std::unique_ptr<ExecutorState> state_;
};

}  // namespace lensgraph::rendergraph
