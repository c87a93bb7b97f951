// Turns an error of the engine into the graph's kind of failure, with what to do about it.
#include "engine/graph/graph_error.h"

namespace lensgraph::engine {
namespace {

using rendergraph::Misuse;

Misuse misuseOf(VkResult result) {
  switch (result) {
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
    case VK_ERROR_OUT_OF_HOST_MEMORY:
    case VK_ERROR_OUT_OF_POOL_MEMORY:
    case VK_ERROR_FRAGMENTED_POOL:
      return Misuse::outOfMemory;
    case VK_ERROR_DEVICE_LOST:
      return Misuse::deviceLost;
    default:
      return Misuse::device;
  }
}

const char* remedyOf(Misuse misuse) {
  if (misuse == Misuse::outOfMemory) return "use a smaller picture or fewer layers";
  if (misuse == Misuse::deviceLost) return "make the device anew; if it happens again, give it less work per pass";
  return "";
}

}  // namespace

void rethrowAsGraphError(const Error& error, std::string_view resource) {
  const auto* vulkan = dynamic_cast<const VulkanError*>(&error);
  const Misuse misuse = vulkan != nullptr ? misuseOf(vulkan->result()) : Misuse::device;
  throw rendergraph::GraphError({{.misuse = misuse,
                                  .pass = {},
                                  .resource = std::string(resource),
                                  .reason = error.what(),
                                  .remedy = remedyOf(misuse),
                                  .where = {}}});
}

}  // namespace lensgraph::engine
