// Interval arithmetic on mips and layers. Sums are made in 64 bits, since counts may be near 2^32.
#include "rendergraph/declare/subresources.h"

#include <cstdint>

namespace lensgraph::rendergraph {

Subresources resolved(const Subresources& range, const ImageDesc& desc) {
  Subresources result = range;
  const auto toEnd = [](uint32_t first, uint32_t total) { return total > first ? total - first : 0; };
  if (result.mipCount == Subresources::kAll) result.mipCount = toEnd(range.firstMip, desc.mips);
  if (result.layerCount == Subresources::kAll) result.layerCount = toEnd(range.firstLayer, desc.layers);
  if (result.aspects == 0) result.aspects = aspectsOf(desc.format);
  return result;
}

bool inside(const Subresources& range, const ImageDesc& desc) {
  // Sums in 64 bits: counts near 2^32 must not wrap into range.
  const auto fits = [](uint64_t first, uint64_t count, uint64_t total) { return count > 0 && first + count <= total; };
  return fits(range.firstMip, range.mipCount, desc.mips) && fits(range.firstLayer, range.layerCount, desc.layers) &&
         range.aspects != 0 && (range.aspects & ~aspectsOf(desc.format)) == 0;
}

bool overlap(const Subresources& a, const Subresources& b) {
  const auto meet = [](uint64_t firstA, uint64_t countA, uint64_t firstB, uint64_t countB) {
    return firstA < firstB + countB && firstB < firstA + countA;
  };
  return meet(a.firstMip, a.mipCount, b.firstMip, b.mipCount) &&
         meet(a.firstLayer, a.layerCount, b.firstLayer, b.layerCount) && (a.aspects & b.aspects) != 0;
}

bool contains(const Subresources& outer, const Subresources& inner) {
  const auto holds = [](uint64_t firstA, uint64_t countA, uint64_t firstB, uint64_t countB) {
    return firstA <= firstB && firstB + countB <= firstA + countA;
  };
  return holds(outer.firstMip, outer.mipCount, inner.firstMip, inner.mipCount) &&
         holds(outer.firstLayer, outer.layerCount, inner.firstLayer, inner.layerCount) &&
         (inner.aspects & ~outer.aspects) == 0;
}

}  // namespace lensgraph::rendergraph
