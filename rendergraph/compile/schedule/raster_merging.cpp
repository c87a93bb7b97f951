// Joins neighboring raster passes with equal attachments into one rendering, as long as nothing has to be ordered between
// them.
#include "rendergraph/compile/schedule/raster_merging.h"

#include "rendergraph/compile/schedule/schedule.h"
#include "rendergraph/declare/declaration.h"
#include "rendergraph/declare/subresources.h"

namespace lensgraph::rendergraph {

namespace {

bool sameAttachment(const DeclaredAccess& a, const DeclaredAccess& b) {
  return a.role == b.role && a.resource == b.resource && a.range == b.range && a.layout == b.layout &&
         a.writes() == b.writes();
}

/// The next attachment at or after an access of a pass.
uint32_t nextAttachment(const Declaration& declaration, uint32_t access) {
  while (access != kNone && declaration.accesses[access].role == AttachmentRole::none) {
    access = declaration.accesses[access].nextOfPass;
  }
  return access;
}

bool sameAttachments(const Declaration& declaration, const DeclaredPass& first, const DeclaredPass& second) {
  uint32_t a = nextAttachment(declaration, first.firstAccess);
  uint32_t b = nextAttachment(declaration, second.firstAccess);
  if (a == kNone) return false;
  while (a != kNone && b != kNone) {
    const DeclaredAccess &one = declaration.accesses[a], &other = declaration.accesses[b];
    if (one.role == AttachmentRole::resolve || !sameAttachment(one, other) || other.load != LoadOp::load) return false;
    a = nextAttachment(declaration, one.nextOfPass);
    b = nextAttachment(declaration, other.nextOfPass);
  }
  return a == kNone && b == kNone;
}

/// Whether an access of a later pass would have to be ordered after one of an earlier pass of the same rendering.
bool needsOrder(const DeclaredResource& resource, const DeclaredAccess& earlier, const DeclaredAccess& later) {
  if (earlier.resource != later.resource || !overlap(resource.isImage, earlier.range, later.range)) return false;
  if (earlier.role != AttachmentRole::none && later.role != AttachmentRole::none) return false;
  return earlier.writes() || later.writes() || earlier.layout != later.layout;
}

bool independent(const Declaration& declaration, uint32_t earlierPass, uint32_t laterPass) {
  for (const DeclaredAccess& access : declaration.accessesOfPass(earlierPass)) {
    for (const DeclaredAccess& later : declaration.accessesOfPass(laterPass)) {
      if (needsOrder(declaration.resources[access.resource], access, later)) return false;
    }
  }
  return true;
}

bool joins(const Declaration& declaration, const Schedule& schedule, uint32_t step) {
  const DeclaredPass& pass = declaration.passes[schedule.order[step]];
  const DeclaredPass& before = declaration.passes[schedule.order[step - 1]];
  if (pass.kind != PassKind::raster || before.kind != PassKind::raster) return false;
  if (schedule.queue[step] != schedule.queue[step - 1] || !sameAttachments(declaration, before, pass)) return false;
  for (uint32_t other = schedule.unitFirst[step - 1]; other < step; ++other) {
    if (!independent(declaration, schedule.order[other], schedule.order[step])) return false;
  }
  return true;
}

}  // namespace

void mergeRasterPasses(const Declaration& declaration, bool merge, Schedule& schedule) {
  const uint32_t steps = schedule.steps();
  schedule.unitFirst.resize(steps);
  schedule.unitLast.resize(steps);
  for (uint32_t step = 0; step < steps; ++step) {
    const bool joined = merge && step > 0 && joins(declaration, schedule, step);
    const uint32_t first = joined ? schedule.unitFirst[step - 1] : step;
    schedule.unitFirst[step] = first;
    for (uint32_t member = first; member <= step; ++member) schedule.unitLast[member] = step;
  }
}

}  // namespace lensgraph::rendergraph
