// Carries out a declaration on a backend: compiles (or finds the plan of an equal structure), makes the resources,
// records every pass with its barriers, submits, and keeps what lives across frames.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include "rendergraph/backend.h"
#include "rendergraph/capture.h"
#include "rendergraph/compiler.h"
#include "rendergraph/graph.h"
#include "rendergraph/plan.h"

namespace rendergraph {

/// How pass times are measured.
enum class Timing : uint8_t {
  none,
  inlineTimestamps,  ///< Two timestamps a pass in the one submission. Cheap; wrong on lavapipe once raster is involved.
  isolated,          ///< Each pass in its own submission with a wait, timed by the host around both. Right on every
                     ///< device, including the cost of one submission (some 10 µs).
};

struct ExecuteOptions {
  CompileOptions compile;
  Timing timing = Timing::none;
};

/// One executor serves one device and any number of declarations, one at a time; not thread-safe.
/// Precondition: the backend outlives the executor.
class Executor {
 public:
  explicit Executor(Backend& backend);
  ~Executor();
  Executor(const Executor&) = delete;
  Executor& operator=(const Executor&) = delete;

  /// Records and submits the graph and waits until the device has finished it. Throws GraphError, and whatever a
  /// recording throws; the executor stays usable. Nothing is submitted when the declaration or a recording is at
  /// fault, except that host passes and isolated timing have had what lies before them submitted; then persistent
  /// content that the graph uses is zeroed again.
  void execute(const Graph& graph, const ExecuteOptions& options = {});

  /// Records the graph into the host's command buffer, which is in the recording state on a queue of the backend's
  /// device; the host submits it. Everything it uses stays alive until the next call or the executor's end, so the
  /// host waits for its submission first. Takes no times; a graph with host passes is refused
  /// (undeclaredAccess), since the host's submission cannot be interrupted.
  void record(const Graph& graph, VkCommandBuffer commands, const ExecuteOptions& options = {});

  /// Of the latest execute() or record(). Valid until the next one.
  const Plan& plan() const;
  const Capture& capture() const;
  /// The Vulkan objects of exported resources of the latest execution.
  VkImage exportedImage(Image image) const;
  VkBuffer exportedBuffer(Buffer buffer) const;
  /// Host-visible content of an exported readback (or upload) buffer.
  std::span<const std::byte> mapped(Buffer buffer) const;

  /// Plans compiled so far, against executions that found theirs: an unchanged frame adds to the second only.
  uint64_t plansCompiled() const;
  uint64_t plansReused() const;

  /// Destroys all resources and plans; persistent content is lost.
  void clear();

 private:
  friend class PassContext;
  friend class Frame;
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace rendergraph
