// What one execution cost: times, bytes, barriers, memory. Plain data; JSON through writeJson().
#pragma once

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

#include "rendergraph/plan.h"

namespace rendergraph {

struct CapturedPass {
  std::string name;
  double gpuMs = -1.0;         ///< Device time; negative when not measured.
  double recordMs = 0.0;       ///< Host time of recording.
  VkDeviceSize bytesRead = 0;  ///< Sizes of the subresources declared as read, each counted once.
  VkDeviceSize bytesWritten = 0;
  uint32_t imageBarriers = 0;
  uint32_t bufferBarriers = 0;
  VkExtent2D resolution = {0, 0};  ///< Of its first written image.
};

struct Capture {
  std::string timing;        ///< "none", "inline", "isolated".
  double frameGpuMs = -1.0;  ///< First to last timestamp, or the sum of isolated passes.
  double frameWallMs = 0.0;  ///< Host: compile, record, submit, wait.
  bool planReused = false;
  std::vector<CapturedPass> passes;  ///< In execution order.
  MemoryReport memory;
};

void writeJson(std::ostream& out, const Capture& capture);

}  // namespace rendergraph
