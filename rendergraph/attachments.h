// Attachments of raster passes with their load and store operations. Pure.
#pragma once

#include "rendergraph/plan.h"

namespace rendergraph {

struct Declaration;
class Cells;
class Timeline;

/// Fills the raster part of every planned pass. An attachment that nobody reads afterwards is not stored.
void planAttachments(const Declaration& declaration, const Cells& cells, const Timeline& timeline, Plan& plan);

}  // namespace rendergraph
