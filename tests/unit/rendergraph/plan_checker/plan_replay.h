// Replays all resources of a plan, and hands what they leave on to those that take over their memory.
#pragma once

#include <cstdint>
#include <vector>

#include "plan_checker/plan_checker.h"
#include "plan_checker/plan_order.h"
#include "plan_checker/resource_replay.h"

namespace lensgraph::plan_checker {

class PlanReplay {
 public:
  explicit PlanReplay(const Setting& setting);
  PlanReplay(const PlanReplay&) = delete;
  PlanReplay& operator=(const PlanReplay&) = delete;

  /// Replays everything and keeps what is handed on.
  std::vector<Finding> run();
  /// After run(): whether nothing is missing for one resource with a change.
  bool holds(uint32_t resource, const Change& change);
  /// After run(): whether nothing is missing with other semaphore waits, of which those of `from` and later
  /// submissions may differ.
  bool holds(const std::vector<Wait>& waits, uint32_t from);

  const PlanOrder& order() const { return order_; }
  ResourceReplay& of(uint32_t resource) { return replays_[resource]; }

 private:
  using RecordTable = std::vector<std::vector<ResourceReplay::Left>>;  // By frame and resource.
  struct Occupant {
    uint32_t frame, resource;
  };
  std::vector<std::vector<Placed>> placeBarriers() const;
  void findPredecessors();
  std::vector<Record> inherited(uint32_t frame, uint32_t resource, const RecordTable& remaining) const;
  RecordTable nothingLeft() const;

  const Setting& setting_;
  PlanOrder order_;
  std::vector<ResourceReplay> replays_;
  std::vector<uint32_t> sequence_;                           // Resources, by first use.
  std::vector<std::vector<std::vector<Occupant>>> before_;   // By frame and resource: earlier owners of its memory.
  std::vector<std::vector<std::vector<Record>>> inherited_;  // By frame and resource.
  RecordTable remaining_;
  std::vector<Finding> overlaps_;
};

}  // namespace lensgraph::plan_checker
