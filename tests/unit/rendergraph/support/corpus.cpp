// Graphs of three shapes with textures of ten sizes, drawn from a seed.
#include "support/corpus.h"

#include <algorithm>
#include <iterator>
#include <random>

namespace lensgraph {

using namespace rendergraph;

namespace corpus {

namespace {

struct TextureSize {
  uint32_t width, height;
  VkFormat format;
};
// 1920×1080×8, ×4, ×4, ×1; 960×540×8, ×4; 480×270×8; 240×135×8; 2048×2048×4; 3840×2160×4 bytes.
constexpr TextureSize kSizes[] = {
    {1920, 1080, VK_FORMAT_R16G16B16A16_SFLOAT}, {1920, 1080, VK_FORMAT_R8G8B8A8_UNORM},
    {1920, 1080, VK_FORMAT_R32_SFLOAT},          {1920, 1080, VK_FORMAT_R8_UNORM},
    {960, 540, VK_FORMAT_R16G16B16A16_SFLOAT},   {960, 540, VK_FORMAT_R8G8B8A8_UNORM},
    {480, 270, VK_FORMAT_R16G16B16A16_SFLOAT},   {240, 135, VK_FORMAT_R16G16B16A16_SFLOAT},
    {2048, 2048, VK_FORMAT_R32_SFLOAT},          {3840, 2160, VK_FORMAT_R8G8B8A8_UNORM}};

std::vector<uint32_t> inputsOf(Workload workload, uint32_t pass, std::mt19937& random) {
  if (pass == 0) return {};
  switch (workload) {
    case Workload::chain2:
      if (pass == 1) return {0};
      return {pass - 1, pass - 2};
    case Workload::dag16: {
      if (pass == 1) return {0};
      const uint32_t other = pass - 1 - static_cast<uint32_t>(random() % std::min(16u, pass));
      return {pass - 1, other};
    }
    case Workload::wide8: {
      constexpr uint32_t kLanes = 8, kBlock = 7 * kLanes + 1;
      const uint32_t within = pass % kBlock;
      if (within == kBlock - 1) {
        std::vector<uint32_t> lanes;
        for (uint32_t lane = 0; lane < kLanes; ++lane) lanes.push_back(pass - kLanes + lane);
        return lanes;
      }
      if (within >= kLanes) return {pass - kLanes};
      if (pass >= kBlock) return {pass - within - 1};
      return {};
    }
  }
  return {};
}

}  // namespace

Shape makeShape(Workload workload, uint32_t seed, uint32_t passes) {
  std::mt19937 random(seed);
  Shape shape;
  for (uint32_t pass = 0; pass < passes; ++pass) shape.inputs.push_back(inputsOf(workload, pass, random));
  for (uint32_t pass = 0; pass < passes; ++pass) {
    shape.sizes.push_back(static_cast<uint32_t>(random() % std::size(kSizes)));
  }
  std::vector<uint8_t> read(passes, 0);
  for (const auto& inputs : shape.inputs) {
    for (uint32_t input : inputs) read[input] = 1;
  }
  for (uint32_t pass = 0; pass < passes; ++pass) {
    if (!read[pass]) shape.unread.push_back(pass);
  }
  return shape;
}

void declare(Graph& graph, const Shape& shape, std::vector<Image>& outputs) {
  outputs.clear();
  for (uint32_t i = 0; i < shape.inputs.size(); ++i) {
    const TextureSize& size = kSizes[shape.sizes[i]];
    Image image = graph.createImage("texture", {.format = size.format, .width = size.width, .height = size.height});
    Pass pass = graph.addPass("pass", PassKind::compute);
    for (uint32_t input : shape.inputs[i]) pass.sample(outputs[input]);
    outputs.push_back(pass.write(image, Usage::storage));
  }
  Pass last = graph.addPass("last", PassKind::compute);
  for (uint32_t pass : shape.unread) last.sample(outputs[pass]);
  Image result = last.write(graph.createImage("result", {.format = VK_FORMAT_R8G8B8A8_UNORM, .width = 8, .height = 8}),
                            Usage::storage);
  graph.exportImage(
      result, {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL});
}

}  // namespace corpus

}  // namespace lensgraph
