// Vulkan's failures as errors of the graph.
#pragma once

#include <string>
#include <string_view>

#include "engine/vulkan/vulkan_api.h"
#include "rendergraph/error.h"

namespace lensgraph::engine {

/// Throws GraphError (outOfMemory, deviceLost, device) "what failed: VK_ERROR_…".
[[noreturn]] void throwGraphError(VkResult result, std::string_view what, std::string_view resource);

/// Throws the same unless the result is VK_SUCCESS.
inline void require(VkResult result, std::string_view what, std::string_view resource = {}) {
  if (result != VK_SUCCESS) throwGraphError(result, what, resource);
}

/// The GraphError that stands for an error of the engine.
[[noreturn]] void rethrowAsGraphError(const Error& error, std::string_view resource);

/// Runs work(); errors of the engine become errors of the graph.
template <class Work>
decltype(auto) withGraphErrors(std::string_view resource, Work&& work) {
  try {
    return work();
  } catch (const Error& error) {
    rethrowAsGraphError(error, resource);
  }
}

}  // namespace lensgraph::engine
