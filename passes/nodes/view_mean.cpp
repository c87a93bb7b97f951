// Nodes: per view the scene and `accumulate`; at the end of the execution `resolve`.
#include "passes/nodes/view_mean.h"

#include <algorithm>

#include "passes/lens/lens_view.h"
#include "passes/nodes/scene_view.h"
#include "passes/nodes/statistics.h"
#include "rendergraph/compute_pass.h"
#include "shaders/shared/accumulation.h"
#include "spirv/accumulation/accumulate_comp.h"
#include "spirv/accumulation/resolve_comp.h"

namespace lensgraph::passes {
namespace {

using rendergraph::Buffer;
using rendergraph::Graph;
using rendergraph::Image;

const rendergraph::ComputeProgram kAccumulate{"accumulation.accumulate", accumulation_accumulate_comp};
const rendergraph::ComputeProgram kResolve{"accumulation.resolve", accumulation_resolve_comp};

/// What persists across executions.
struct Running {
  Image mean, spread;
};

void declareAccumulate(Graph& graph, const DofInputs& inputs, const std::string& prefix, Image viewColor,
                       const LensSample& sample, uint32_t viewIndex, Running& running, Buffer& statistics) {
  const shared::AccumulatePush push{.aperture = inputs.aperture,
                                    .lensSample = sample.v,
                                    .weight = sample.weight,
                                    .viewIndex = viewIndex,
                                    .extent = {inputs.extent.width, inputs.extent.height}};
  compute(graph, prefix + ".accumulate", kAccumulate)
      .read(viewColor)
      .modify(running.mean)
      .modify(running.spread)
      .modify(statistics)
      .push(push)
      .groups(rendergraph::groupsFor(inputs.extent, shared::kAccumulationTile));
}

DofOutputs declareResolve(Graph& graph, const DofInputs& inputs, const std::string& prefix, const Running& running,
                          uint32_t views) {
  const auto [width, height] = inputs.extent;
  DofOutputs out;
  out.color = graph.createImage(prefix + ".color", {.format = kViewColorFormat, .width = width, .height = height});
  out.standardError =
      graph.createImage(prefix + ".standard_error", {.format = VK_FORMAT_R32_SFLOAT, .width = width, .height = height});
  const shared::ResolvePush push{.extent = {width, height}, .viewCount = views};
  compute(graph, prefix + ".resolve", kResolve)
      .read(running.mean)
      .read(running.spread)
      .write(out.color)
      .write(out.standardError)
      .push(push)
      .groups(rendergraph::groupsFor(inputs.extent, shared::kAccumulationTile));
  return out;
}

}  // namespace

uint32_t frameCount(const ViewMean& mean) {
  return (mean.viewCount + mean.viewsPerFrame - 1) / mean.viewsPerFrame;
}

DofOutputs declareViewMean(Graph& graph, const DofInputs& inputs, const ViewMean& mean) {
  const auto [width, height] = inputs.extent;
  Running running;
  running.mean = graph.persistentImage(mean.prefix + ".mean",
                                       {.format = VK_FORMAT_R32G32B32A32_SFLOAT, .width = width, .height = height});
  running.spread = graph.persistentImage(mean.prefix + ".spread",
                                         {.format = VK_FORMAT_R32_SFLOAT, .width = width, .height = height});
  Buffer statistics = declareStatistics(graph, mean.prefix);

  const uint64_t first = uint64_t{inputs.frame} * mean.viewsPerFrame;
  const uint64_t last = std::min<uint64_t>(first + mean.viewsPerFrame, mean.viewCount);
  for (uint64_t view = first; view < last; ++view) {
    // Numbered within the execution, so that every execution has the same structure.
    const std::string name = mean.prefix + ".view" + std::to_string(view - first);
    const LensSample sample = mean.sample(static_cast<uint32_t>(view));
    const auto drawn =
        declareSceneView(graph, inputs, name, viewFromLens(inputs, sample.v, sample.pixelOffset), statistics);
    statistics = drawn.statistics;
    declareAccumulate(graph, inputs, name, drawn.color, sample, static_cast<uint32_t>(view), running, statistics);
  }
  auto out = declareResolve(graph, inputs, mean.prefix, running, static_cast<uint32_t>(std::max(last, uint64_t{1})));
  out.statistics = statistics;
  return out;
}

}  // namespace lensgraph::passes
