// Writes plans by hand, for tests of the plan checker: what is not said is filled in from the declaration, with a
// heap for each resource.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <vector>

#include "rendergraph/compiler.h"
#include "rendergraph/graph.h"
#include "rendergraph/plan.h"

namespace lensgraph {

class PlanMaker {
 public:
  using Images = std::vector<rendergraph::ImageBarrier>;
  using Buffers = std::vector<rendergraph::BufferBarrier>;
  struct Event {
    uint32_t setAfter;
    Images images;
    Buffers buffers;
  };

  PlanMaker(const rendergraph::Graph& graph, const rendergraph::DeviceFacts& device)
      : declaration_(graph.declaration()), device_(device) {}

  /// The following steps belong to a new submission.
  PlanMaker& submission(uint32_t queue, std::initializer_list<rendergraph::SubmissionWait> waits = {});
  PlanMaker& step(uint32_t pass, const Images& images = {}, const Buffers& buffers = {},
                  const std::vector<Event>& events = {});
  /// The step just added draws in the rendering of the one before.
  PlanMaker& continues();
  /// Barriers at the end of the submission.
  PlanMaker& atEnd(const Images& images, const Buffers& buffers = {});
  /// The resource is created for several queue families.
  PlanMaker& concurrent(uint32_t resource);
  /// The plan, with placements, persistent resources and counts.
  rendergraph::Plan finish();

 private:
  rendergraph::BarrierBatch batch(const Images& images, const Buffers& buffers);
  void addAttachments(rendergraph::PlannedPass& planned);
  void place();
  void count();

  const rendergraph::Declaration& declaration_;
  const rendergraph::DeviceFacts& device_;
  rendergraph::Plan plan_;
  std::vector<uint32_t> concurrent_;
};

}  // namespace lensgraph
