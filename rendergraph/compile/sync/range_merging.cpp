// Three sweeps: along layers, along mips, over aspects. Ranges stay rectangles.
#include "rendergraph/compile/sync/range_merging.h"

#include <algorithm>
#include <tuple>

namespace lensgraph::rendergraph {

namespace {

auto meaningOf(const PendingBarrier& found) {
  const ImageBarrier& b = found.barrier;
  // A release and its acquire must name the same range, so neither is joined to others.
  const bool transfer = b.reason == BarrierReason::release || b.reason == BarrierReason::acquire;
  const Subresources own = transfer ? b.range : Subresources{};
  return std::tuple(found.step, found.earliest, found.setAfter, found.submission, b.from.pass, b.from.stages,
                    b.from.access, b.to.pass, b.to.stages, b.to.access, b.oldLayout, b.newLayout, b.fromQueue,
                    b.toQueue, b.reason, own.firstMip, own.firstLayer, own.aspects);
}

/// `key` sorts barriers so that those to be joined stand side by side; `join` extends the first by the second.
template <class Key, class Join>
void sweep(std::vector<PendingBarrier>& barriers, Key&& key, Join&& join) {
  std::sort(barriers.begin(), barriers.end(), [&](const PendingBarrier& a, const PendingBarrier& b) {
    return std::tuple(meaningOf(a), key(a.barrier.range)) < std::tuple(meaningOf(b), key(b.barrier.range));
  });
  std::size_t kept = 0;
  for (std::size_t i = 1; i < barriers.size(); ++i) {
    const bool joined = meaningOf(barriers[kept]) == meaningOf(barriers[i]) &&
                        join(barriers[kept].barrier.range, barriers[i].barrier.range);
    if (!joined) barriers[++kept] = barriers[i];
  }
  barriers.resize(kept + 1);
}

}  // namespace

void mergeRanges(std::vector<PendingBarrier>& barriers) {
  if (barriers.size() < 2) return;
  sweep(
      barriers, [](const Subresources& r) { return std::tuple(r.aspects, r.firstMip, r.firstLayer); },
      [](Subresources& a, const Subresources& b) {
        if (a.aspects != b.aspects || a.firstMip != b.firstMip || a.firstLayer + a.layerCount != b.firstLayer) {
          return false;
        }
        a.layerCount += b.layerCount;
        return true;
      });
  sweep(
      barriers, [](const Subresources& r) { return std::tuple(r.aspects, r.firstLayer, r.layerCount, r.firstMip); },
      [](Subresources& a, const Subresources& b) {
        if (a.aspects != b.aspects || a.firstLayer != b.firstLayer || a.layerCount != b.layerCount ||
            a.firstMip + a.mipCount != b.firstMip) {
          return false;
        }
        a.mipCount += b.mipCount;
        return true;
      });
  sweep(
      barriers,
      [](const Subresources& r) { return std::tuple(r.firstLayer, r.layerCount, r.firstMip, r.mipCount, r.aspects); },
      [](Subresources& a, const Subresources& b) {
        Subresources same = b;
        same.aspects = a.aspects;
        if (!(same == a)) return false;
        a.aspects |= b.aspects;
        return true;
      });
}

}  // namespace lensgraph::rendergraph
