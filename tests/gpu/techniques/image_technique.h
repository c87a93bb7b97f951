// Runs a technique of TechniqueInput::image on pixels given by a test and reads the result back.
#pragma once

#include <array>
#include <memory>
#include <string_view>
#include <vector>

#include "passes/registry/registry.h"
#include "rendergraph/executor.h"
#include "shaders/shared/statistics.h"

namespace lensgraph::support {

using Rgba = std::array<float, 4>;

struct ImageInput {
  VkExtent2D extent = {0, 0};
  std::vector<Rgba> color;   ///< Row by row.
  std::vector<float> depth;  ///< What a depth buffer would hold; see lens.vergenceScale.
  shared::LensConstants lens{};
  bool colorHasAlpha = false;  ///< As DofInputs::colorHasAlpha.
};

struct ImageOutput {
  std::vector<Rgba> color;
  shared::FrameStatistics statistics{};
  rendergraph::Capture capture;
};

/// Pipelines are kept between runs. The device is support::device().
class ImageTechniqueRunner {
 public:
  ImageTechniqueRunner();
  ~ImageTechniqueRunner();

  /// Of the registry; by name, or any other.
  ImageOutput run(std::string_view technique, const ImageInput& input, const passes::ParameterSet& parameters = {},
                  rendergraph::Timing timing = rendergraph::Timing::none);
  ImageOutput run(const passes::Technique& technique, const ImageInput& input,
                  const passes::ParameterSet& parameters = {}, rendergraph::Timing timing = rendergraph::Timing::none);

 private:
  struct Gpu;
  std::unique_ptr<Gpu> gpu_;
};

}  // namespace lensgraph::support
