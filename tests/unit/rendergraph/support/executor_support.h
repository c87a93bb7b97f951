// Graphs and checks that several tests of the executor share.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "rendergraph/executor.h"
#include "support/fake_backend.h"

namespace lensgraph::executor_test {

inline const rendergraph::ComputeProgram kCompute{.name = "program", .shader = {}};
inline const rendergraph::RasterProgram kRaster{
    .name = "raster", .vertex = {}, .geometry = {}, .fragment = {}, .state = {}};
inline const rendergraph::ImageDesc kDesc{.format = VK_FORMAT_R16G16B16A16_SFLOAT, .width = 64, .height = 32};
inline const rendergraph::AccessState kSampled{VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
                                               VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
                                               VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
inline const rendergraph::AccessState kHostRead{VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT};

inline void expectClean(const FakeBackend& backend) {
  EXPECT_THAT(backend.mistakes, testing::IsEmpty());
}

inline rendergraph::Misuse misuseOf(const std::function<void()>& action, std::string* text = nullptr) {
  try {
    action();
  } catch (const rendergraph::GraphError& error) {
    if (text != nullptr) *text = error.what();
    return error.misuse();
  }
  ADD_FAILURE() << "nothing was thrown";
  return rendergraph::Misuse::cycle;
}

struct Chain {
  rendergraph::Image half, result;
};
/// Raster, compute, export. `clear` changes a value only, `width` (px) the structure.
Chain declareChain(rendergraph::Graph& graph, float clear = 1.0f, uint32_t width = 64);

/// A frame with one of everything: `width` px wide, a chain of `passes` compute passes between a raster pass and a
/// read-back, a history, an upload buffer that a host pass fills when `host` is set.
struct Everything {
  uint32_t width = 64;
  uint32_t passes = 4;
  bool host = true;
  bool history = true;
};
/// Returns the read-back buffer.
rendergraph::Buffer declare(rendergraph::Graph& graph, const Everything& what);

}  // namespace lensgraph::executor_test
