// Image views made on demand and kept as long as their images.
#pragma once

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

#include "rendergraph/execute/resources/unique_handle.h"

namespace lensgraph::rendergraph {

class ViewCache {
 public:
  /// Throws GraphError (device) when the backend cannot make the view.
  VkImageView get(Backend& backend, const ViewDesc& desc, std::string_view name) {
    // A few views per image and few images: a linear search beats hashing the description.
    const auto found = std::find_if(views_.begin(), views_.end(), [&](const auto& v) { return v.first == desc; });
    if (found != views_.end()) return found->second.get();
    views_.reserve(views_.size() + 1);  // So that nothing throws once the view exists.
    views_.emplace_back(desc, UniqueView(backend, backend.createView(desc, name)));
    return views_.back().second.get();
  }
  void clear() { views_.clear(); }

 private:
  std::vector<std::pair<ViewDesc, UniqueView>> views_;
};

}  // namespace lensgraph::rendergraph
