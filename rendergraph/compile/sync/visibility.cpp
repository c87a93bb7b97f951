// A scope covers a use when it includes all stages and accesses of the use, collective flags expanded.
#include "rendergraph/compile/sync/visibility.h"

#include "rendergraph/compile/flow/stage_masks.h"

namespace lensgraph::rendergraph {

bool Visibility::covers(VkPipelineStageFlags2 stages, VkAccessFlags2 access) const {
  if (everything_) return true;
  for (std::size_t i = 0; i < count_; ++i) {
    if ((expandedStages(stages) & ~expandedStages(scopes_[i].stages)) == 0 &&
        (expandedAccess(access) & ~expandedAccess(scopes_[i].access)) == 0) {
      return true;
    }
  }
  return false;
}

VkAccessFlags2 Visibility::uncovered(VkPipelineStageFlags2 stages, VkAccessFlags2 access) const {
  VkAccessFlags2 result = 0;
  forEachBit(access, [&](VkAccessFlags2 bit) {
    if (!covers(stages, bit)) result |= bit;
  });
  return result;
}

}  // namespace lensgraph::rendergraph
