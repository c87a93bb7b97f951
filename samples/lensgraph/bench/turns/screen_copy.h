// A full-screen copy: the least that any pass over a picture costs, as a unit of time.
#pragma once

#include <cstdint>

#include "engine/graph/graph_backend.h"
#include "engine/vulkan/device.h"
#include "rendergraph/executor.h"
#include "rendergraph/graph.h"
#include "samples/lensgraph/bench/turns/turn.h"

namespace lensgraph::cli {

/// Copies one RGBA32F picture to another, through the render graph as every technique is.
class ScreenCopy {
 public:
  /// Sides in px, at least 1. The device outlives it.
  ScreenCopy(const engine::Device& device, uint32_t width, uint32_t height);

  TurnTimes copy();

 private:
  engine::GraphBackend backend_;
  rendergraph::Executor executor_;
  rendergraph::Graph graph_;
  uint32_t width_, height_;
  bool isFilled_ = false;
};

}  // namespace lensgraph::cli
