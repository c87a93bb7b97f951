// A host that brings its own volk: its global pointers and Lensgraph's tables must not touch each other.
#define VOLK_IMPLEMENTATION
#include <volk.h>

#include <cstdint>
#include <cstdio>
#include <exception>

#include "fill_graph.h"

int main() {
  if (volkInitialize() != VK_SUCCESS) {
    std::puts("volk finds no Vulkan loader");
    return 1;
  }
  const auto enumerateInstanceVersion = vkEnumerateInstanceVersion;
  try {
    const bool executed = fillAndReadBack();
    // As volk left them: loaded by the host, and not filled by Lensgraph's instance and device.
    const bool untouched = vkEnumerateInstanceVersion == enumerateInstanceVersion && vkCreateDevice == nullptr &&
                           vkCmdFillBuffer == nullptr && volkGetLoadedInstance() == VK_NULL_HANDLE;
    uint32_t version = 0;
    const bool works = vkEnumerateInstanceVersion(&version) == VK_SUCCESS && version >= VK_API_VERSION_1_3;
    std::printf("executed %d, volk untouched %d and working %d\n", executed, untouched, works);
    return executed && untouched && works ? 0 : 1;
  } catch (const std::exception& error) {
    std::printf("failed: %s\n", error.what());
    return 1;
  }
}
