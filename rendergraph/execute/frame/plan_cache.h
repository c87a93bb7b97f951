// Plans by structural hash, the latest first, with the objects of the few used last.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include "rendergraph/execute/resources/deletion_queue.h"
#include "rendergraph/execute/resources/plan_resources.h"
#include "rendergraph/plan.h"

namespace lensgraph::rendergraph {

struct CachedPlan {
  uint64_t hash = 0;
  Plan plan;
  std::unique_ptr<PlanResources> resources;  ///< None until executed, and again when others pushed it out.
};

class PlanCache {
 public:
  /// Frames in flight may use the objects that the cache gives up.
  explicit PlanCache(DeletionQueue& deletionQueue) : deletionQueue_(deletionQueue) {}

  /// The plan with this hash, moved to the front; null when there is none.
  CachedPlan* find(uint64_t hash) {
    const auto found = std::find_if(plans_.begin(), plans_.end(), [&](const auto& plan) { return plan->hash == hash; });
    if (found == plans_.end()) return nullptr;
    std::rotate(plans_.begin(), found, found + 1);
    return plans_.front().get();
  }
  CachedPlan& add(uint64_t hash, Plan plan) {
    plans_.insert(plans_.begin(), std::make_unique<CachedPlan>(CachedPlan{hash, std::move(plan), nullptr}));
    releaseResources(kPlans);
    if (plans_.size() > kPlans) plans_.pop_back();
    return *plans_.front();
  }
  /// Gives up the objects of all plans but the `keep` used last.
  void releaseResources(std::size_t keep) {
    for (std::size_t i = keep; i < plans_.size(); ++i) {
      if (plans_[i]->resources) deletionQueue_.add(std::move(plans_[i]->resources));
    }
  }
  void clear() {
    releaseResources(0);
    plans_.clear();
  }

  // A plan is some kilobytes; a host rarely alternates between more graphs than this.
  static constexpr std::size_t kPlans = 16;
  // Objects cost memory wherever heaps cannot be shared, e.g. after growing: keep only what alternates frame by frame.
  static constexpr std::size_t kWithResources = 3;

 private:
  DeletionQueue& deletionQueue_;
  std::vector<std::unique_ptr<CachedPlan>> plans_;
};

}  // namespace lensgraph::rendergraph
