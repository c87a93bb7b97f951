// Nodes of the two-pass filter (Zhou 2007). The formulas are in shaders/two_pass_filter/.
#include "passes/two_pass_filter/two_pass_filter.h"

#include <array>
#include <string>

#include "passes/nodes/statistics.h"
#include "rendergraph/compute_pass.h"
#include "rendergraph/error.h"
#include "shaders/shared/statistics.h"
#include "shaders/shared/two_pass_filter.h"
#include "spirv/two_pass_filter/horizontal_alpha_comp.h"
#include "spirv/two_pass_filter/horizontal_comp.h"
#include "spirv/two_pass_filter/prepare_comp.h"
#include "spirv/two_pass_filter/reach_comp.h"
#include "spirv/two_pass_filter/tiles_comp.h"
#include "spirv/two_pass_filter/vertical_alpha_comp.h"
#include "spirv/two_pass_filter/vertical_comp.h"

namespace lensgraph::passes::two_pass_filter {
namespace {

using rendergraph::Buffer;
using rendergraph::ComputeProgram;
using rendergraph::Graph;
using rendergraph::groupsFor;
using rendergraph::Image;

const ComputeProgram kPrepare{"two_pass_filter.prepare", two_pass_filter_prepare_comp};
const ComputeProgram kTiles{"two_pass_filter.tiles", two_pass_filter_tiles_comp};
const ComputeProgram kReach{"two_pass_filter.reach", two_pass_filter_reach_comp};
const ComputeProgram kVertical{"two_pass_filter.vertical", two_pass_filter_vertical_comp};
const ComputeProgram kVerticalAlpha{"two_pass_filter.vertical_alpha", two_pass_filter_vertical_alpha_comp};
const ComputeProgram kHorizontalAlpha{"two_pass_filter.horizontal_alpha", two_pass_filter_horizontal_alpha_comp};
const ComputeProgram kHorizontal{"two_pass_filter.horizontal", two_pass_filter_horizontal_comp};

/// rgb and CoC of one pixel in one load. Half floats would be slower here and round the CoC to 1/1024 of
/// itself.
constexpr VkFormat kFilterFormat = VK_FORMAT_R32G32B32A32_SFLOAT;

/// What every node of one declaration needs.
struct Frame {
  VkExtent2D extent;
  rendergraph::Groups tiles;
  shared::TwoPassFilterConstants constants;
  bool keepsAlpha;

  rendergraph::ImageDesc image() const {
    return {.format = kFilterFormat, .width = extent.width, .height = extent.height};
  }
  VkDeviceSize tileBytes(VkDeviceSize bytesPerTile) const { return VkDeviceSize{tiles.x} * tiles.y * bytesPerTile; }
};

Frame frameOf(const DofInputs& inputs, const Parameters& parameters) {
  Frame frame{.extent = inputs.extent,
              .tiles = groupsFor(inputs.extent, shared::kTwoPassFilterTile),
              .constants = {},
              .keepsAlpha = inputs.colorHasAlpha};
  auto& constants = frame.constants;
  constants.lens = inputs.lens;
  constants.maxRadius = parameters.maxRadius;
  constants.minRadius = parameters.minRadius;
  constants.leakage = parameters.leakage;
  constants.size = {static_cast<int32_t>(inputs.extent.width), static_cast<int32_t>(inputs.extent.height)};
  constants.tiles = {static_cast<int32_t>(frame.tiles.x), static_cast<int32_t>(frame.tiles.y)};
  return frame;
}

void requireSize(const Graph& graph, Image image, const char* name, VkExtent2D extent) {
  const auto& desc = graph.desc(image);
  if (desc.width == extent.width && desc.height == extent.height) return;
  const auto text = [](uint32_t width, uint32_t height) {
    return std::to_string(width) + "x" + std::to_string(height);
  };
  throw rendergraph::GraphError({{.misuse = rendergraph::Misuse::sizeMismatch,
                                  .pass = kPrepare.name,
                                  .resource = name,
                                  .reason = "the image is " + text(desc.width, desc.height) +
                                            " px, DofInputs::extent says " + text(extent.width, extent.height),
                                  .remedy = "give colour and depth at full resolution",
                                  .where = std::source_location::current()}});
}

/// A picture between two passes: rgb and CoC, and alpha where it is kept.
struct Filtered {
  Image image;
  Buffer alphas;
};

Filtered createFiltered(Graph& graph, const Frame& frame, const char* imageName, const char* alphasName) {
  Filtered created{graph.createImage(imageName, frame.image()), {}};
  const VkDeviceSize pixels = VkDeviceSize{frame.extent.width} * frame.extent.height;
  if (frame.keepsAlpha) created.alphas = graph.createBuffer(alphasName, {.size = pixels * sizeof(float)});
  return created;
}

Filtered declarePrepare(Graph& graph, const DofInputs& inputs, const Frame& frame, Buffer& statistics) {
  Filtered prepared = createFiltered(graph, frame, "two_pass_filter.prepared", "two_pass_filter.prepared_alphas");
  // A view of a depth-stencil image that is sampled must name one aspect.
  rendergraph::Subresources depthRange = rendergraph::mip(0);
  depthRange.aspects =
      rendergraph::aspectsOf(graph.desc(inputs.depth).format) & (VK_IMAGE_ASPECT_COLOR_BIT | VK_IMAGE_ASPECT_DEPTH_BIT);
  auto pass = compute(graph, kPrepare.name, kPrepare);
  pass.sample(inputs.color, rendergraph::kNearest, rendergraph::mip(0))
      .sample(inputs.depth, rendergraph::kNearest, depthRange)
      .write(prepared.image)
      .modify(statistics);
  frame.keepsAlpha ? pass.write(prepared.alphas) : pass.placeholder();
  pass.push(frame.constants).specialize({frame.keepsAlpha}).groups(frame.tiles);
  return prepared;
}

Buffer declareTiles(Graph& graph, const Frame& frame, Image prepared, Buffer& statistics) {
  constexpr uint32_t kGroup = 8;  // tiles; as in tiles.comp
  Buffer tileRadii = graph.createBuffer("two_pass_filter.tile_radii", {.size = frame.tileBytes(sizeof(float))});
  compute(graph, kTiles.name, kTiles)
      .read(prepared)
      .write(tileRadii)
      .modify(statistics)
      .push(frame.constants)
      .groups(groupsFor({frame.tiles.x, frame.tiles.y}, kGroup));
  return tileRadii;
}

Buffer declareReach(Graph& graph, const Frame& frame, Buffer tileRadii) {
  Buffer tileTaps = graph.createBuffer("two_pass_filter.tile_taps", {.size = frame.tileBytes(sizeof(shared::uvec2))});
  compute(graph, kReach.name, kReach)
      .read(tileRadii)
      .write(tileTaps)
      .push(frame.constants)
      .groups(groupsFor({frame.tiles.x, frame.tiles.y}, shared::kTwoPassFilterTile));
  return tileTaps;
}

Filtered declareVertical(Graph& graph, const Frame& frame, const Filtered& source, Buffer tileTaps) {
  Filtered columns = createFiltered(graph, frame, "two_pass_filter.columns", "two_pass_filter.column_alphas");
  auto pass = compute(graph, kVertical.name, frame.keepsAlpha ? kVerticalAlpha : kVertical);
  pass.read(source.image).write(columns.image).read(tileTaps);
  if (frame.keepsAlpha) pass.read(source.alphas).write(columns.alphas);
  pass.push(frame.constants).groups(frame.tiles);
  return columns;
}

Image declareHorizontal(Graph& graph, const Frame& frame, const Filtered& source, Buffer tileTaps) {
  Image result = graph.createImage("two_pass_filter.color", frame.image());
  auto pass = compute(graph, kHorizontal.name, frame.keepsAlpha ? kHorizontalAlpha : kHorizontal);
  pass.read(source.image).write(result).read(tileTaps);
  if (frame.keepsAlpha) pass.read(source.alphas);
  pass.push(frame.constants).groups(frame.tiles);
  return result;
}

}  // namespace

std::span<const Field<Parameters>> fields() {
  static const std::array<Field<Parameters>, 3> all = {
      number<&Parameters::maxRadius>("maxRadius", "px", 1.0, 1024.0,
                                     "Blur radii are limited to it, and pixels that it limits are counted "
                                     "(clampedCoc). Costs nothing where blurs "
                                     "are smaller; time grows with the radius that the picture has."),
      number<&Parameters::minRadius>("minRadius", "px", 0.1, 2.0,
                                     "Radius below which a blur no longer gets brighter. Smaller keeps what "
                                     "is in focus sharper against blur "
                                     "that covers it; larger lets that blur show. No cost."),
      number<&Parameters::leakage>("leakage", "1/px", 0.0, 16.0,
                                   "How fast the background may spread over a pixel as that pixel's own blur "
                                   "radius grows: min(1, leakage * r). "
                                   "0 stops all spreading behind the focal plane; large values let it onto "
                                   "edges near focus. No cost."),
  };
  return all;
}

DofOutputs declare(Graph& graph, const DofInputs& inputs, const Parameters& parameters) {
  DofOutputs outputs;
  outputs.color = inputs.color;
  if (inputs.lens.cocScale == 0.0f) return outputs;
  requireSize(graph, inputs.color, "color", inputs.extent);
  requireSize(graph, inputs.depth, "depth", inputs.extent);

  const Frame frame = frameOf(inputs, parameters);
  outputs.statistics = declareStatistics(graph, "two_pass_filter");
  const Filtered prepared = declarePrepare(graph, inputs, frame, outputs.statistics);
  const Buffer tileRadii = declareTiles(graph, frame, prepared.image, outputs.statistics);
  const Buffer tileTaps = declareReach(graph, frame, tileRadii);
  const Filtered columns = declareVertical(graph, frame, prepared, tileTaps);
  outputs.color = declareHorizontal(graph, frame, columns, tileTaps);
  return outputs;
}

namespace {

// The filter's shape is its own.
constexpr std::string_view kIgnoredLensFields[] = {"bladeCount",      "bladeRotation",     "bladeCurvature",
                                                   "anamorphicRatio", "opticalVignetting", "sphericalAberration"};

}  // namespace

Technique technique() {
  return makeTechnique<Parameters>(
      {.name = "two_pass_filter",
       .title = "Two-pass filter",
       .source = "Zhou, Chen, Pullen 2007, Accurate Depth of Field Simulation in Real Time",
       .input = TechniqueInput::image,
       .fields = fields(),
       .ignoredLensFields = kIgnoredLensFields,
       .blurLimit = "maxRadius",
       .declare = declare});
}

}  // namespace lensgraph::passes::two_pass_filter
