// Kinds of failure and what to do about them.
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

[[noreturn]] void raise(Misuse misuse, std::string reason, std::string_view resource) {
  throw rendergraph::GraphError({{.misuse = misuse,
                                  .pass = {},
                                  .resource = std::string(resource),
                                  .reason = std::move(reason),
                                  .remedy = remedyOf(misuse),
                                  .where = {}}});
}

}  // namespace

void throwGraphError(VkResult result, std::string_view what, std::string_view resource) {
  raise(misuseOf(result), std::string(what) + " failed: " + std::string(nameOf(result)), resource);
}

void rethrowAsGraphError(const Error& error, std::string_view resource) {
  const auto* vulkan = dynamic_cast<const VulkanError*>(&error);
  raise(vulkan != nullptr ? misuseOf(vulkan->result()) : Misuse::device, error.what(), resource);
}

}  // namespace lensgraph::engine
