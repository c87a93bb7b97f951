// What every technique takes and gives.
#pragma once

#include <vulkan/vulkan_core.h>

#include <array>
#include <cstdint>

#include "passes/scene_draw.h"
#include "rendergraph/graph.h"
#include "shaders/shared/aperture.h"
#include "shaders/shared/lens.h"

namespace lensgraph::passes {

/// The projection without its lens.
struct Projection {
  float pixelsPerTangent = 1.0f;  ///< S, px: half the image height over tan(fovy / 2).
  float nearPlane = 0.01f;        ///< n, m; the far plane is at infinity, depth reversed.
};

struct DofInputs {
  VkExtent2D extent = {0, 0};    ///< px.
  shared::LensConstants lens{};  ///< cocScale 0 means no depth of field.
  shared::ApertureShape aperture{};
  Projection projection;

  /// For techniques on images (TechniqueInput::image): linear HDR colour RGBA, premultiplied, full resolution …
  rendergraph::Image color;
  /// … and depth: any single-channel format; vergence = lens.vergenceScale · value + lens.vergenceOffset.
  rendergraph::Image depth;
  /// Whether alpha of `color` may differ from 1. It is blurred as the colours are.
  bool colorHasAlpha = false;

  /// For techniques that draw (TechniqueInput::scene). Null otherwise; must outlive the recording.
  const SceneDraw* scene = nullptr;
  /// Linear radiance where nothing is hit.
  std::array<float, 3> background = {0.0f, 0.0f, 0.0f};

  /// Progressive techniques refine over several executions of the graph: number of this execution, from 0.
  uint32_t frame = 0;
};

struct DofOutputs {
  rendergraph::Image color;  ///< Linear HDR RGBA, RGBA32F; alpha 1, except of an image that has it.
  /// Raw reversed depth of the pinhole view, for techniques that draw one; default-made otherwise.
  rendergraph::Image depth;
  /// Standard error of the luma of `color`, R32F, of progressive techniques; default-made otherwise.
  rendergraph::Image standardError;
  /// FrameStatistics (shaders/shared/statistics.h), one buffer per technique; default-made when it has none.
  rendergraph::Buffer statistics;
};

}  // namespace lensgraph::passes
