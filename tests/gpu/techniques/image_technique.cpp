// Imports two pictures, declares one technique between them, executes it, and reads the result back.
#include "tests/gpu/techniques/image_technique.h"

#include <gtest/gtest.h>

#include <cstring>
#include <memory>
#include <span>
#include <stdexcept>

#include "engine/graph/graph_backend.h"
#include "engine/vulkan/memory.h"
#include "tests/support/gpu/gpu_test.h"

namespace lensgraph::support {
namespace {

using rendergraph::Usage;

template <class Texel>
engine::GpuImage uploaded(VkExtent2D extent, VkFormat format, const std::vector<Texel>& texels, const char* name) {
  constexpr VkImageUsageFlags usage =
      VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  auto image =
      engine::makeImage(device(), {.format = format, .width = extent.width, .height = extent.height}, usage, name);
  engine::upload(device(), image, std::as_bytes(std::span(texels)));
  return image;
}

rendergraph::Image imported(rendergraph::Graph& graph, const engine::GpuImage& image, const char* name) {
  const rendergraph::AccessState uploadedState = {.stages = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                                                  .access = VK_ACCESS_2_MEMORY_READ_BIT,
                                                  .layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
  return graph.importImage(name, image.desc,
                           {.image = image.image.get(),
                            .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                            .before = uploadedState,
                            .after = uploadedState});
}

constexpr rendergraph::AccessState kHostRead = {.stages = VK_PIPELINE_STAGE_2_HOST_BIT,
                                                .access = VK_ACCESS_2_HOST_READ_BIT};

rendergraph::Buffer readbackBuffer(rendergraph::Graph& graph, const char* name, VkDeviceSize size) {
  return graph.createBuffer(name, {.size = size, .memory = rendergraph::MemoryKind::readback});
}

rendergraph::Buffer readback(rendergraph::Graph& graph, rendergraph::Image image, VkDeviceSize size) {
  auto buffer = readbackBuffer(graph, "test.pixels", size);
  auto pass = graph.addPass("test.read_pixels", rendergraph::PassKind::transfer);
  pass.read(image, Usage::transferSource);
  buffer = pass.write(buffer, Usage::transferDestination);
  pass.record([=](rendergraph::PassContext& context) { context.copyImageToBuffer(image, buffer); });
  graph.exportBuffer(buffer, kHostRead);
  return buffer;
}

rendergraph::Buffer readback(rendergraph::Graph& graph, rendergraph::Buffer from, VkDeviceSize size) {
  auto buffer = readbackBuffer(graph, "test.statistics", size);
  auto pass = graph.addPass("test.read_statistics", rendergraph::PassKind::transfer);
  pass.read(from, Usage::transferSource);
  buffer = pass.write(buffer, Usage::transferDestination);
  pass.record([=](rendergraph::PassContext& context) { context.copyBuffer(from, buffer, size); });
  graph.exportBuffer(buffer, kHostRead);
  return buffer;
}

}  // namespace

struct ImageTechniqueRunner::Gpu {
  engine::GraphBackend backend{device()};
  rendergraph::Executor executor{backend};
};

ImageTechniqueRunner::ImageTechniqueRunner() : gpu_(std::make_unique<Gpu>()) {}
ImageTechniqueRunner::~ImageTechniqueRunner() = default;

ImageOutput ImageTechniqueRunner::run(std::string_view technique, const ImageInput& input,
                                      const passes::ParameterSet& parameters, rendergraph::Timing timing) {
  const auto* found = passes::findTechnique(technique);
  if (found == nullptr) throw std::runtime_error("no such technique");
  return run(*found, input, parameters, timing);
}

ImageOutput ImageTechniqueRunner::run(const passes::Technique& technique, const ImageInput& input,
                                      const passes::ParameterSet& parameters, rendergraph::Timing timing) {
  const auto color = uploaded(input.extent, VK_FORMAT_R32G32B32A32_SFLOAT, input.color, "test color");
  const auto depth = uploaded(input.extent, VK_FORMAT_R32_SFLOAT, input.depth, "test depth");

  rendergraph::Graph graph;
  passes::DofInputs inputs;
  inputs.extent = input.extent;
  inputs.lens = input.lens;
  inputs.colorHasAlpha = input.colorHasAlpha;
  inputs.color = imported(graph, color, "color");
  inputs.depth = imported(graph, depth, "depth");
  EXPECT_TRUE(check(parameters, technique.parameters).empty());
  const auto configured = technique.configure(parameters);
  EXPECT_TRUE(configured->validate(inputs).empty());
  const auto outputs = configured->declare(graph, inputs);

  const auto pixels = readback(graph, outputs.color, input.color.size() * sizeof(Rgba));
  rendergraph::Buffer statistics;
  if (outputs.statistics) statistics = readback(graph, outputs.statistics, sizeof(shared::FrameStatistics));
  gpu_->executor.execute(graph, {.compile = {}, .timing = timing});

  ImageOutput output;
  output.color.resize(input.color.size());
  std::memcpy(output.color.data(), gpu_->executor.mapped(pixels).data(), output.color.size() * sizeof(Rgba));
  if (statistics) {
    std::memcpy(&output.statistics, gpu_->executor.mapped(statistics).data(), sizeof(output.statistics));
  }
  output.capture = gpu_->executor.capture();
  return output;
}

}  // namespace lensgraph::support
