// Vulkan's failures as errors of the graph.
#pragma once

#include <string>
#include <string_view>

#include "engine/vulkan/vulkan_api.h"
#include "rendergraph/error.h"

namespace lensgraph::engine {

/// Throws the GraphError (outOfMemory, deviceLost, device) that stands for an error of the engine.
[[noreturn]] void rethrowAsGraphError(const Error& error, std::string_view resource);

/// Runs work(); errors of the engine become errors of the graph that name the resource.
template <class Work>
decltype(auto) withGraphErrors(std::string_view resource, Work&& work) {
  try {
    return work();
  } catch (const Error& error) {
    rethrowAsGraphError(error, resource);
  }
}

/// check() for the graph's backend: throws GraphError "what failed: VK_ERROR_…" unless the result is VK_SUCCESS.
inline void checkForGraph(VkResult result, std::string_view what, std::string_view resource = {}) {
  withGraphErrors(resource, [&] { check(result, what); });
}

}  // namespace lensgraph::engine
