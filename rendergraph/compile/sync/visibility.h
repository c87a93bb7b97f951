// To which stages and accesses the content of a cell is visible.
#pragma once

#include <vulkan/vulkan_core.h>

#include <array>
#include <cstddef>

namespace lensgraph::rendergraph {

/// Scopes to which the content of a cell was made visible. Two are kept; a third adds nothing, and the planner then
/// makes the content visible once more.
class Visibility {
 public:
  static Visibility toEverything() {
    Visibility visibility;
    visibility.everything_ = true;
    return visibility;
  }
  static Visibility to(VkPipelineStageFlags2 stages, VkAccessFlags2 access) {
    Visibility visibility;
    visibility.add(stages, access);
    return visibility;
  }
  void add(VkPipelineStageFlags2 stages, VkAccessFlags2 access) {
    if (count_ < scopes_.size()) scopes_[count_++] = {stages, access};
  }
  bool covers(VkPipelineStageFlags2 stages, VkAccessFlags2 access) const;
  /// The accesses that some of the stages cannot rely on.
  VkAccessFlags2 uncovered(VkPipelineStageFlags2 stages, VkAccessFlags2 access) const;

 private:
  struct Scope {
    VkPipelineStageFlags2 stages = 0;
    VkAccessFlags2 access = 0;
  };
  // One scope for the host's own use before the graph and one for the barrier of a run of reads.
  std::array<Scope, 2> scopes_;
  std::size_t count_ = 0;
  bool everything_ = false;
};

}  // namespace lensgraph::rendergraph
