// Load operations follow from the declaration, store operations from what comes later.
#include "rendergraph/compile/attachments.h"

#include <vector>

#include "rendergraph/compile/flow/cells.h"
#include "rendergraph/compile/schedule/cell_uses.h"
#include "rendergraph/compile/schedule/schedule.h"
#include "rendergraph/declare/declaration.h"

namespace lensgraph::rendergraph {

namespace {

/// Whether anybody needs what an access leaves after the rendering that begins at `step`.
bool readLater(const Declaration& declaration, const Cells& cells, const CellUses& cellUses, uint32_t access,
               uint32_t step) {
  const DeclaredResource& resource = declaration.resources[declaration.accesses[access].resource];
  bool read = false;
  cells.forEach(access, [&](uint32_t cell) {
    for (const CellUse& use : cellUses.of(cell)) {
      if (use.step <= step) continue;
      read = read || use.needsContent;
      return;
    }
    read = read || resource.observable();  // The last use: what remains is the result.
  });
  return read;
}

VkAttachmentLoadOp loadOpOf(LoadOp load) {
  switch (load) {
    case LoadOp::clear:
      return VK_ATTACHMENT_LOAD_OP_CLEAR;
    case LoadOp::load:
      return VK_ATTACHMENT_LOAD_OP_LOAD;
    case LoadOp::dontCare:
      return VK_ATTACHMENT_LOAD_OP_DONT_CARE;
  }
  return VK_ATTACHMENT_LOAD_OP_LOAD;
}

/// The same attachments for a later pass of the rendering, which finds them loaded.
Run continued(Plan& plan, const Run& attachments) {
  const Run run{static_cast<uint32_t>(plan.attachments.size()), attachments.count};
  for (uint32_t i = 0; i < attachments.count; ++i) {
    PlannedAttachment attachment = plan.attachments[attachments.first + i];
    attachment.load = VK_ATTACHMENT_LOAD_OP_LOAD;
    plan.attachments.push_back(attachment);
  }
  return run;
}

/// Gathers the attachments of one rendering.
class Rendering {
 public:
  Rendering(const Declaration& declaration, const Cells& cells, const CellUses& cellUses, uint32_t step)
      : declaration_(declaration), cells_(cells), cellUses_(cellUses), step_(step) {}

  void add(uint32_t index) {
    const DeclaredAccess& access = declaration_.accesses[index];
    PlannedAttachment attachment{.resource = access.resource,
                                 .range = access.range,
                                 .layout = access.layout,
                                 .load = loadOpOf(access.load),
                                 .store = VK_ATTACHMENT_STORE_OP_STORE};
    if (!access.writes()) {
      attachment.store = VK_ATTACHMENT_STORE_OP_NONE;  // STORE would count as a write.
    } else if (!readLater(declaration_, cells_, cellUses_, index, step_)) {
      attachment.store = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    }
    switch (access.role) {
      case AttachmentRole::none:
        break;
      case AttachmentRole::color:
        colors_.push_back(attachment);
        break;
      case AttachmentRole::depth:
        depths_.push_back(attachment);
        break;
      case AttachmentRole::resolve:
        colors_.back().resolve = static_cast<uint32_t>(resolved_.size());  // An index of the plan in the end.
        resolved_.push_back(attachment);
        break;
    }
  }

  void appendTo(Plan& plan, PlannedPass& planned) {
    const auto first = static_cast<uint32_t>(plan.attachments.size());
    planned.colors = {first, static_cast<uint32_t>(colors_.size())};
    planned.depth = {first + planned.colors.count, static_cast<uint32_t>(depths_.size())};
    for (PlannedAttachment& color : colors_) {
      if (color.resolve != kNone) color.resolve += planned.depth.first + planned.depth.count;
    }
    plan.attachments.insert(plan.attachments.end(), colors_.begin(), colors_.end());
    plan.attachments.insert(plan.attachments.end(), depths_.begin(), depths_.end());
    plan.attachments.insert(plan.attachments.end(), resolved_.begin(), resolved_.end());
  }

 private:
  const Declaration& declaration_;
  const Cells& cells_;
  const CellUses& cellUses_;
  uint32_t step_;
  std::vector<PlannedAttachment> colors_, depths_, resolved_;
};

}  // namespace

void planAttachments(const Declaration& declaration, const Cells& cells, const CellUses& cellUses,
                     const Schedule& schedule, Plan& plan) {
  for (uint32_t step = 0; step < plan.passes.size(); ++step) {
    PlannedPass& planned = plan.passes[step];
    const DeclaredPass& pass = declaration.passes[planned.pass];
    if (pass.kind != PassKind::raster) continue;
    planned.renderArea = pass.renderArea;
    planned.renderLayers = pass.renderLayers;
    if (schedule.unitFirst[step] != step) {
      const PlannedPass& first = plan.passes[schedule.unitFirst[step]];
      planned.continuesRendering = true;
      planned.colors = continued(plan, first.colors);
      planned.depth = continued(plan, first.depth);
      continue;
    }
    Rendering rendering(declaration, cells, cellUses, step);
    for (const DeclaredAccess& access : declaration.accessesOfPass(planned.pass)) {
      if (access.role != AttachmentRole::none) rendering.add(declaration.numberOf(access));
    }
    rendering.appendTo(plan, planned);
  }
}

}  // namespace lensgraph::rendergraph
