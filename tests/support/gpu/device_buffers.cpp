// Host-visible buffers of the test device, filled and read through mapped memory.
#include "tests/support/gpu/device_buffers.h"

#include "tests/support/gpu/gpu_test.h"

namespace lensgraph::support {

using rendergraph::Usage;

FilledBuffer::FilledBuffer(std::span<const std::byte> content)
    : buffer_(engine::makeBuffer(
          device(), content.size(),
          VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
          rendergraph::MemoryKind::device, "test buffer")) {
  engine::upload(device(), buffer_, content);
}

rendergraph::Buffer FilledBuffer::importInto(rendergraph::Graph& graph, const char* name) const {
  const rendergraph::AccessState rest{.stages = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                                      .access = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT};
  return graph.importBuffer(name, {.size = buffer_.size},
                            {.buffer = buffer_.buffer.get(),
                             .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                             .before = rest,
                             .after = rest});
}

rendergraph::Buffer declareReadBack(rendergraph::Graph& graph, rendergraph::Buffer buffer) {
  const VkDeviceSize size = graph.desc(buffer).size;
  auto bytes = graph.createBuffer("read back", {.size = size, .memory = rendergraph::MemoryKind::readback});
  auto copy = graph.addPass("read back", rendergraph::PassKind::transfer);
  copy.read(buffer, Usage::transferSource);
  bytes = copy.write(bytes, Usage::transferDestination);
  copy.record([=](rendergraph::PassContext& context) { context.copyBuffer(buffer, bytes, size); });
  graph.exportBuffer(bytes, {.stages = VK_PIPELINE_STAGE_2_HOST_BIT, .access = VK_ACCESS_2_HOST_READ_BIT});
  return bytes;
}

}  // namespace lensgraph::support
