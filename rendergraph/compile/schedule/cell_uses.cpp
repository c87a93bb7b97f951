// Sorts the uses of all cells by counting.
#include "rendergraph/compile/schedule/cell_uses.h"

#include "rendergraph/compile/flow/cells.h"
#include "rendergraph/compile/flow/stage_masks.h"
#include "rendergraph/compile/schedule/schedule.h"
#include "rendergraph/declare/access_table.h"
#include "rendergraph/declare/declaration.h"

namespace lensgraph::rendergraph {

CellUses::CellUses(const Declaration& declaration, const Cells& cells, const Schedule& schedule)
    : starts_(cells.count() + 1, 0) {
  for (uint32_t index = 0; index < declaration.accesses.size(); ++index) {
    cells.forEach(index, [&](uint32_t cell) { ++starts_[cell + 1]; });
  }
  for (uint32_t cell = 0; cell < cells.count(); ++cell) starts_[cell + 1] += starts_[cell];
  ends_.assign(starts_.begin(), starts_.end() - 1);
  uses_.resize(starts_.back());
  for (uint32_t step = 0; step < schedule.steps(); ++step) {
    const uint32_t pass = schedule.order[step];
    const uint32_t unit = schedule.unitFirst[step];
    for (const DeclaredAccess& access : declaration.accessesOfPass(pass)) {
      cells.forEach(declaration.numberOf(access), [&](uint32_t cell) {
        const bool first = ends_[cell] == starts_[cell] || uses_[ends_[cell] - 1].step != unit;
        if (first) {
          CellUse& use = uses_[ends_[cell]++];
          use.step = unit;
          use.pass = pass;
          use.layout = access.layout;
          use.queue = schedule.queue[step];
        }
        CellUse& use = uses_[ends_[cell] - 1];
        use.lastPass = pass;
        // Later passes of the rendering find what the first one left.
        use.needsContent = use.needsContent || (access.needsContent() && use.pass == pass);
        use.writes = use.writes || access.writes();
        use.stages |= access.stages;
        // What they load or blend with was written in the rendering itself.
        const bool inside = use.pass != pass && access.role != AttachmentRole::none;
        use.access |= inside ? access.access & kWriteAccess : access.access;
      });
    }
  }
}

std::optional<CellUse> useAfterGraph(const DeclaredResource& resource, std::span<const CellUse> uses,
                                     VkImageLayout layoutBefore, uint32_t steps, bool overlappingFrames) {
  if (!resource.observable()) return std::nullopt;
  AccessState after = resource.persistent() ? restStateOf(resource) : resource.after;
  const VkImageLayout current = uses.empty() ? layoutBefore : uses.back().layout;
  if (!resource.isImage || after.layout == VK_IMAGE_LAYOUT_UNDEFINED) after.layout = current;
  const bool elsewhere = !uses.empty() && uses.back().queue != 0;  // Queue 0 owns it in the end.
  if (after.stages == 0 && after.layout == current && !elsewhere) return std::nullopt;
  // A change of layout or owner is a write, which the next frame's first use must find a stage to wait for at.
  const bool changed = elsewhere || after.layout != current;
  if (overlappingFrames && resource.created() && changed && (after.stages & ~VK_PIPELINE_STAGE_2_HOST_BIT) == 0) {
    after.stages |= kChainStage;
  }
  return CellUse{.step = steps,
                 .pass = kNone,
                 .lastPass = kNone,
                 .layout = after.layout,
                 .stages = after.stages,
                 .access = after.access,
                 .queue = 0,
                 .writes = writesMemory(after.access),
                 .needsContent = true};
}

}  // namespace lensgraph::rendergraph
