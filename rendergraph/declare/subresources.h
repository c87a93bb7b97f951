// Ranges of mips, layers and aspects of one image: resolving their defaults, and comparing them.
#pragma once

#include "rendergraph/resource.h"

namespace lensgraph::rendergraph {

/// The range with its defaults replaced by numbers; it may lie outside the image.
Subresources resolved(const Subresources& range, const ImageDesc& desc);
/// Whether a resolved range is not empty and lies inside the image.
bool inside(const Subresources& range, const ImageDesc& desc);
/// Whether two resolved ranges share a subresource.
bool overlap(const Subresources& a, const Subresources& b);
/// The same for accesses to any resource: two accesses to one buffer always overlap.
inline bool overlap(bool isImage, const Subresources& a, const Subresources& b) {
  return !isImage || overlap(a, b);
}
/// Whether every subresource of `inner` lies in `outer`; both resolved.
bool contains(const Subresources& outer, const Subresources& inner);

}  // namespace lensgraph::rendergraph
