// A technique declared without a device: inputs of a host that does not exist, all outputs asked for.
#pragma once

#include <vulkan/vulkan_core.h>

#include "passes/registry/registry.h"
#include "rendergraph/graph.h"

namespace lensgraph {

struct BareOptions {
  VkExtent2D extent = {640, 360};  ///< px.
  passes::ParameterSet parameters = {};
  bool hasTransparency = false;
  float cocScale = 20.0f;  ///< px·m
};

/// `scene` is what the recordings refer to; it must outlive the graph.
void declareBare(rendergraph::Graph& graph, const passes::Technique& technique, const BareOptions& options,
                 passes::SceneDraw& scene);

}  // namespace lensgraph
