// Load operations follow from the declaration, store operations from what comes later.
#include "rendergraph/attachments.h"

#include "rendergraph/cells.h"
#include "rendergraph/declaration.h"
#include "rendergraph/timeline.h"

namespace rendergraph {

namespace {

bool readLater(const Declaration& declaration, const Cells& cells, const Timeline& timeline, uint32_t access,
               uint32_t step) {
  const DeclaredResource& resource = declaration.resources[declaration.accesses[access].resource];
  bool read = false;
  cells.forEach(access, [&](uint32_t cell) {
    for (const CellUse& use : timeline.of(cell)) {
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

Run append(std::vector<PlannedAttachment>& all, const std::vector<PlannedAttachment>& some) {
  const Run run{static_cast<uint32_t>(all.size()), static_cast<uint32_t>(some.size())};
  all.insert(all.end(), some.begin(), some.end());
  return run;
}

}  // namespace

void planAttachments(const Declaration& declaration, const Cells& cells, const Timeline& timeline, Plan& plan) {
  for (uint32_t step = 0; step < plan.passes.size(); ++step) {
    PlannedPass& planned = plan.passes[step];
    const DeclaredPass& pass = declaration.passes[planned.pass];
    if (pass.kind != PassKind::raster) continue;
    planned.renderArea = pass.renderArea;
    planned.renderLayers = pass.renderLayers;
    std::vector<PlannedAttachment> colors, depths;
    for (uint32_t index = pass.firstAccess; index != kNone; index = declaration.accesses[index].nextOfPass) {
      const DeclaredAccess& access = declaration.accesses[index];
      if (access.role == AttachmentRole::none) continue;
      PlannedAttachment attachment{.resource = access.resource,
                                   .range = access.range,
                                   .layout = access.layout,
                                   .load = loadOpOf(access.load),
                                   .store = VK_ATTACHMENT_STORE_OP_STORE};
      if (!access.writes()) {
        attachment.store = VK_ATTACHMENT_STORE_OP_NONE;  // STORE would count as a write.
      } else if (!readLater(declaration, cells, timeline, index, step)) {
        attachment.store = VK_ATTACHMENT_STORE_OP_DONT_CARE;
      }
      (access.role == AttachmentRole::color ? colors : depths).push_back(attachment);
    }
    planned.colors = append(plan.attachments, colors);
    planned.depth = append(plan.attachments, depths);
  }
}

}  // namespace rendergraph
