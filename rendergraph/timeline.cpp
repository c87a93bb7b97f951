// Sorts the uses of all cells by counting.
#include "rendergraph/timeline.h"

#include "rendergraph/cells.h"
#include "rendergraph/declaration.h"

namespace rendergraph {

Timeline::Timeline(const Declaration& declaration, const Cells& cells, std::span<const uint32_t> order)
    : starts_(cells.count() + 1, 0) {
  for (uint32_t index = 0; index < declaration.accesses.size(); ++index) {
    cells.forEach(index, [&](uint32_t cell) { ++starts_[cell + 1]; });
  }
  for (uint32_t cell = 0; cell < cells.count(); ++cell) starts_[cell + 1] += starts_[cell];
  ends_.assign(starts_.begin(), starts_.end() - 1);
  uses_.resize(starts_.back());
  for (uint32_t step = 0; step < order.size(); ++step) {
    const uint32_t pass = order[step];
    for (uint32_t index = declaration.passes[pass].firstAccess; index != kNone;
         index = declaration.accesses[index].nextOfPass) {
      const DeclaredAccess& access = declaration.accesses[index];
      cells.forEach(index, [&](uint32_t cell) {
        const bool first = ends_[cell] == starts_[cell] || uses_[ends_[cell] - 1].step != step;
        if (first) {
          uses_[ends_[cell]++] = {.step = step, .pass = pass, .layout = access.layout};
        }
        CellUse& use = uses_[ends_[cell] - 1];
        use.needsContent = use.needsContent || access.needsContent();
        use.writes = use.writes || access.writes();
        use.stages |= access.stages;
        use.access |= access.access;
      });
    }
  }
}

}  // namespace rendergraph
