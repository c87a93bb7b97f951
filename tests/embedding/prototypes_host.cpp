// A host that calls libvulkan through its prototypes, declares a technique of Lensgraph, compiles it without a device
// and executes a small graph on a device of Lensgraph's.
#include <vulkan/vulkan.h>

#include <cstdint>
#include <cstdio>
#include <exception>

#include "fill_graph.h"
#include "passes/two_pass_filter/two_pass_filter.h"
#include "rendergraph/compiler.h"
#include "rendergraph/graph.h"

namespace {

namespace rendergraph = lensgraph::rendergraph;
namespace passes = lensgraph::passes;

/// An instance of the host's own, by libvulkan's functions; true when they work.
bool callLibvulkan() {
  uint32_t version = 0;
  if (vkEnumerateInstanceVersion(&version) != VK_SUCCESS || version < VK_API_VERSION_1_3) return false;
  VkApplicationInfo application{};
  application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
  application.apiVersion = VK_API_VERSION_1_3;
  VkInstanceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
  info.pApplicationInfo = &application;
  VkInstance instance = VK_NULL_HANDLE;
  const VkResult result = vkCreateInstance(&info, nullptr, &instance);
  if (result == VK_ERROR_INCOMPATIBLE_DRIVER) return true;  // libvulkan answers, but has no driver to ask.
  if (result != VK_SUCCESS) return false;
  uint32_t devices = 0;
  const bool works = vkEnumeratePhysicalDevices(instance, &devices, nullptr) == VK_SUCCESS;
  vkDestroyInstance(instance, nullptr);
  std::printf("libvulkan %u.%u, %u devices\n", VK_API_VERSION_MAJOR(version), VK_API_VERSION_MINOR(version), devices);
  return works;
}

/// The two-pass filter on pictures of the host's; true when its plan has all its passes, in shared memory.
bool compileTechnique() {
  constexpr uint32_t kWidth = 320, kHeight = 180;
  rendergraph::ImportedImage host;
  host.usage = VK_IMAGE_USAGE_SAMPLED_BIT;
  host.before.layout = host.after.layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
  rendergraph::Graph graph;
  passes::DofInputs inputs;
  inputs.extent = {kWidth, kHeight};
  inputs.color =
      graph.importImage("color", {.format = VK_FORMAT_R16G16B16A16_SFLOAT, .width = kWidth, .height = kHeight}, host);
  inputs.depth = graph.importImage("depth", {.format = VK_FORMAT_D32_SFLOAT, .width = kWidth, .height = kHeight}, host);
  inputs.lens.cocScale = 20.0f;       // px·m
  inputs.lens.focusVergence = 0.5f;   // 1/m: focused at 2 m
  inputs.lens.maxCocRadius = 30.0f;   // px
  inputs.lens.vergenceScale = 10.0f;  // 1/m: reversed depth, near plane at 0.1 m
  inputs.aperture.anamorphicRatio = 1.0f;
  const passes::two_pass_filter::Parameters parameters;
  for (const passes::Problem& problem : passes::checkInputs(passes::TechniqueInput::image, inputs)) {
    std::printf("%s: %s\n", problem.parameter.c_str(), problem.reason.c_str());
    return false;
  }
  const auto outputs = passes::two_pass_filter::declare(graph, inputs, parameters);
  graph.exportImage(outputs.color, {VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
                                    VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL});
  const auto plan = rendergraph::compile(graph.declaration(), {}, rendergraph::NominalDevice());
  std::printf("two_pass_filter: %zu passes, %llu bytes, %llu without sharing\n", plan.passes.size(),
              static_cast<unsigned long long>(plan.memory.peakBytes),
              static_cast<unsigned long long>(plan.memory.unaliasedBytes));
  return plan.passes.size() == 6 && plan.culled.empty() && plan.memory.peakBytes >= kWidth * kHeight * 16u &&
         plan.memory.peakBytes <= plan.memory.unaliasedBytes;
}

}  // namespace

int main() {
  try {
    const bool compiled = compileTechnique();
    const bool before = callLibvulkan();
    const bool executed = fillAndReadBack();
    const bool after = callLibvulkan();
    std::printf("compiled %d, libvulkan %d and %d, executed %d\n", compiled, before, after, executed);
    return compiled && before && executed && after ? 0 : 1;
  } catch (const std::exception& error) {
    std::printf("failed: %s\n", error.what());
    return 1;
  }
}
