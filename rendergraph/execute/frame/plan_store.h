// Plans of an executor with their objects, and what lives across its frames.
#pragma once

#include <cstdint>
#include <span>

#include "rendergraph/backend.h"
#include "rendergraph/compile_options.h"
#include "rendergraph/execute/frame/plan_cache.h"
#include "rendergraph/execute/resources/deletion_queue.h"
#include "rendergraph/execute/resources/heap_pool.h"
#include "rendergraph/execute/resources/persistent_store.h"

namespace lensgraph::rendergraph {

struct Declaration;

/// One frame after the other: select() its plan, makeObjects(), enterInto() a table, then commit() or abandon() it. Between the
/// first and the last call current() is that frame's plan; afterwards, until the next select(), that of the latest frame.
class PlanStore {
 public:
  /// The backend outlives the store. `framesInFlight`: at least 1.
  PlanStore(Backend& backend, uint32_t framesInFlight) : backend_(backend), framesInFlight_(framesInFlight) {}

  /// Finds the plan of an equal structure, or compiles one. Returns whether it was found. Throws GraphError with the
  /// problems of the declaration.
  bool select(const Declaration& declaration, const CompileOptions& options);
  /// Null before the first frame, and after a select() that threw.
  const Plan* current() const { return current_ != nullptr ? &current_->plan : nullptr; }
  /// Whether the device may still execute a frame of another plan in the memory of the current one.
  bool followsAnotherPlan() const { return !isFirst_ && previousHash_ != current_->hash; }

  /// Makes the objects of the current plan for this frame in flight. Throws GraphError (outOfMemory, device) that names
  /// the resource; what was made remains for the next attempt.
  void makeObjects(const Declaration& declaration, uint32_t frameInFlight);
  /// Enters them and the persistent resources, which are made where they do not exist yet, into the table. Throws as
  /// makeObjects() does.
  void enterInto(ResourceTable& table, const Declaration& declaration, uint32_t frameInFlight);
  /// Gives up the objects of all other plans, so that their memory is free once the device has finished with them.
  void giveUpOthers() { plans_.releaseResources(1); }
  std::span<const UniqueEvent> events(uint32_t frameInFlight) const {
    return current_->resources->events(frameInFlight);
  }
  PersistentStore& persistent() { return persistent_; }

  /// The frame was submitted or recorded under this number.
  void commit(uint64_t frame);
  /// The frame broke off after a part of it was submitted: its persistent content is unknown.
  void abandon();
  /// Nobody knows which frames the device executed: all persistent content is unknown.
  void distrust();
  /// Destroys what only frames up to this number needed.
  void release(uint64_t finishedFrame) { deletionQueue_.release(finishedFrame); }
  /// Objects given up from now on are needed by frames up to this number.
  void setLastUser(uint64_t frame) { deletionQueue_.setLastUser(frame); }
  /// Destroys everything. The device has finished all frames.
  void clear();

  /// Plans by structural hash. A test may put a plan there that no declaration leads to.
  PlanCache& cache() { return plans_; }
  uint64_t compiled() const { return compiled_; }
  uint64_t reused() const { return reused_; }

 private:
  // In the order in which they use one another; destroyed the other way round.
  Backend& backend_;
  uint32_t framesInFlight_;
  DeletionQueue deletionQueue_;
  HeapPool pool_;
  PlanCache plans_{deletionQueue_};
  PersistentStore persistent_{backend_, deletionQueue_};
  CachedPlan* current_ = nullptr;
  bool isFirst_ = true;        // No frame has been submitted or recorded yet.
  uint64_t previousHash_ = 0;  // Hash of the latest frame's plan; 0: there is none, or the frame broke off.
  uint64_t compiled_ = 0, reused_ = 0;
};

}  // namespace lensgraph::rendergraph
