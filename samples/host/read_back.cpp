// Copies into readback memory, and what is made of the bytes.
#include "samples/host/read_back.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

namespace lensgraph::host {

using rendergraph::Buffer;
using rendergraph::Graph;
using rendergraph::Image;
using rendergraph::MemoryKind;
using rendergraph::PassContext;
using rendergraph::PassKind;
using rendergraph::Usage;

namespace {
constexpr rendergraph::AccessState kHostRead{VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT,
                                             VK_IMAGE_LAYOUT_UNDEFINED};
}

Buffer readBack(Graph& graph, Image image, const char* name) {
  const auto& desc = graph.desc(image);
  const VkDeviceSize size = VkDeviceSize{desc.width} * desc.height * rendergraph::texelSize(desc.format);
  Buffer buffer = graph.createBuffer(name, {.size = size, .memory = MemoryKind::readback});
  auto pass = graph.addPass(std::string(name) + ".copy", PassKind::transfer);
  pass.read(image, Usage::transferSource);
  buffer = pass.write(buffer, Usage::transferDestination);
  pass.record([image, buffer](PassContext& context) { context.copyImageToBuffer(image, buffer); });
  graph.exportBuffer(buffer, kHostRead);
  return buffer;
}

Buffer readBack(Graph& graph, Buffer from, const char* name) {
  const VkDeviceSize size = graph.desc(from).size;
  Buffer buffer = graph.createBuffer(name, {.size = size, .memory = MemoryKind::readback});
  auto pass = graph.addPass(std::string(name) + ".copy", PassKind::transfer);
  pass.read(from, Usage::transferSource);
  buffer = pass.write(buffer, Usage::transferDestination);
  pass.record([from, buffer, size](PassContext& context) { context.copyBuffer(from, buffer, size); });
  graph.exportBuffer(buffer, kHostRead);
  return buffer;
}

engine::FloatImage imageFrom(std::span<const std::byte> bytes, VkExtent2D extent, uint32_t channels) {
  engine::FloatImage image(extent.width, extent.height, channels);
  std::memcpy(image.samples.data(), bytes.data(), image.samples.size() * sizeof(float));
  return image;
}

double rootMeanSquare(std::span<const std::byte> bytes) {
  const std::size_t count = bytes.size() / sizeof(float);
  double sum = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    float value = 0.0f;
    std::memcpy(&value, bytes.data() + i * sizeof value, sizeof value);
    sum += static_cast<double>(value) * static_cast<double>(value);
  }
  return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(count, 1)));
}

}  // namespace lensgraph::host
