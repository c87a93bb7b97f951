// Attachments of raster passes with their load and store operations. Pure.
#pragma once

#include "rendergraph/plan.h"

namespace lensgraph::rendergraph {

struct Declaration;
struct Schedule;
class Cells;
class CellUses;

/// Fills the raster part of every PlannedPass. Passes that share one rendering have the same attachments, with the
/// first one's load and what is stored after the last.
void planAttachments(const Declaration& declaration, const Cells& cells, const CellUses& cellUses,
                     const Schedule& schedule, Plan& plan);

}  // namespace lensgraph::rendergraph
