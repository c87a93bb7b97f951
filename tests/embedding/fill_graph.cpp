// Declares a fill and a copy, executes them on the first usable device and compares the bytes that come back.
#include "fill_graph.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <vector>

#include "engine/graph/graph_backend.h"
#include "engine/vulkan/device.h"
#include "engine/vulkan/vulkan_api.h"
#include "rendergraph/executor.h"
#include "rendergraph/graph.h"

namespace rendergraph = lensgraph::rendergraph;
using rendergraph::Usage;

namespace {

bool hasUsableDevice() {
  try {
    const auto devices = lensgraph::engine::listDevices();
    return std::ranges::any_of(devices, [](const auto& device) { return device.missing.empty(); });
  } catch (const lensgraph::engine::VulkanError& error) {
    if (error.result() == VK_ERROR_INCOMPATIBLE_DRIVER) return false;  // The loader found no driver at all.
    throw;
  }
}

}  // namespace

bool fillAndReadBack() {
  if (!hasUsableDevice()) {
    std::puts("no usable Vulkan device: nothing executed");
    return true;
  }
  const lensgraph::engine::Device device;
  lensgraph::engine::GraphBackend backend(device);
  rendergraph::Executor executor(backend);

  constexpr uint32_t kWord = 0x1e45641fu, kWords = 64;
  rendergraph::Graph graph;
  auto filled = graph.createBuffer("filled", {.size = kWords * sizeof kWord});
  rendergraph::Pass fill = graph.addPass("fill", rendergraph::PassKind::transfer);
  filled = fill.write(filled, Usage::transferDestination);
  fill.record([=](rendergraph::PassContext& context) { context.fillBuffer(filled, kWord); });
  auto result =
      graph.createBuffer("result", {.size = kWords * sizeof kWord, .memory = rendergraph::MemoryKind::readback});
  rendergraph::Pass copy = graph.addPass("copy", rendergraph::PassKind::transfer);
  copy.read(filled, Usage::transferSource);
  result = copy.write(result, Usage::transferDestination);
  copy.record([=](rendergraph::PassContext& context) { context.copyBuffer(filled, result, kWords * sizeof kWord); });
  graph.exportBuffer(result, {.stages = VK_PIPELINE_STAGE_2_HOST_BIT, .access = VK_ACCESS_2_HOST_READ_BIT});
  executor.execute(graph);

  const auto bytes = executor.mapped(result);
  std::vector<uint32_t> words(bytes.size() / sizeof(uint32_t));
  std::memcpy(words.data(), bytes.data(), words.size() * sizeof(uint32_t));
  const auto right = std::ranges::count(words, kWord);
  std::printf("%s: %td of %zu words are right\n", device.description().name.c_str(), right, words.size());
  return words.size() == kWords && right == static_cast<std::ptrdiff_t>(kWords);
}
