// Adjacent raster passes that can share one rendering. Pure.
#pragma once

namespace lensgraph::rendergraph {

struct Declaration;
struct Schedule;

/// Sets Schedule::unitFirst and unitLast; with `merge` off, every step stands alone. Precondition: order and queues
/// are set.
///
/// A pass joins the rendering before it when both draw into the same attachments, loading what is there, on the same
/// queue, nothing is resolved in between, and nothing else that the two touch has to be ordered: what a rendering does
/// to its attachments is ordered by rasterization order (Vulkan 1.3, 28.3), everything else would need a barrier.
void mergeRasterPasses(const Declaration& declaration, bool merge, Schedule& schedule);

}  // namespace lensgraph::rendergraph
