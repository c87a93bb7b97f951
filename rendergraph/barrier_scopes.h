// What the collective stage and access flags stand for, and to whom content is visible.
#pragma once

#include <vulkan/vulkan_core.h>

#include <array>
#include <cstddef>

#include "rendergraph/access.h"

namespace rendergraph {

VkPipelineStageFlags2 expandedStages(VkPipelineStageFlags2 stages);
VkAccessFlags2 expandedAccess(VkAccessFlags2 access);

/// To whom the content of a cell is visible.
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

}  // namespace rendergraph
