// Makes the pipeline of each emit when it is first asked for, and records the scene's draws with it. Descriptor set 0 is
// the scene, set 1 a material's textures, set 2 what the emit writes to.
#include "engine/draw/scene_renderer.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "engine/draw/scene_constants.h"
#include "engine/vulkan/command_buffers.h"
#include "engine/vulkan/raster_pipeline.h"
#include "engine/vulkan/vulkan_functions.h"
#include "spirv/scene/fragment_list_frag.h"
#include "spirv/scene/layer_radiance_frag.h"
#include "spirv/scene/layer_surface_frag.h"
#include "spirv/scene/layers_geom.h"
#include "spirv/scene/opaque_radiance_frag.h"
#include "spirv/scene/scene_vert.h"
#include "spirv/scene/transparent_list_frag.h"

namespace lensgraph::engine {
namespace {

using rendergraph::MemoryKind;
using shared::SceneEmit;

constexpr std::array<VkVertexInputAttributeDescription, 5> kAttributes = {{
    {0, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(SceneVertex, position)},
    {1, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(SceneVertex, normal)},
    {2, 0, VK_FORMAT_R32G32_SFLOAT, offsetof(SceneVertex, uv0)},
    {3, 0, VK_FORMAT_R32G32_SFLOAT, offsetof(SceneVertex, uv1)},
    {4, 0, VK_FORMAT_R32G32B32A32_SFLOAT, offsetof(SceneVertex, color)},
}};
constexpr VkVertexInputBindingDescription kVertexBinding{0, sizeof(SceneVertex), VK_VERTEX_INPUT_RATE_VERTEX};

constexpr std::array<BindingKind, 5> kSceneBindings = {BindingKind::storageBuffer, BindingKind::storageBuffer,
                                                       BindingKind::storageBuffer, BindingKind::uniformBuffer,
                                                       BindingKind::sampledImage};

/// Which surfaces an emit draws: the alpha-blended ones, all others, or both.
enum class Surfaces : uint8_t { opaque, blended, all };

/// How an emit is drawn.
struct EmitTraits {
  const char* name;
  rendergraph::SpirV geometry, fragment;
  Surfaces surfaces = Surfaces::opaque;
  bool testsDepth = true;
  bool writesDepth = true;
  bool frontOnly = false;  ///< Leaves out what faces away; by the shader, which knows of mirrored objects.
};

EmitTraits traitsOf(SceneEmit emit) {
  switch (emit) {
    case SceneEmit::opaqueRadiance:
      return {.name = "scene.opaque_radiance", .geometry = {}, .fragment = scene_opaque_radiance_frag};
    case SceneEmit::transparentList:
      return {.name = "scene.transparent_list",
              .geometry = {},
              .fragment = scene_transparent_list_frag,
              .surfaces = Surfaces::blended,
              .writesDepth = false};
    case SceneEmit::opaqueLayers:
      return {.name = "scene.opaque_layers", .geometry = scene_layers_geom, .fragment = scene_layer_radiance_frag};
    case SceneEmit::transparentLayers:
      return {.name = "scene.transparent_layers",
              .geometry = scene_layers_geom,
              .fragment = scene_layer_radiance_frag,
              .surfaces = Surfaces::blended};
    case SceneEmit::opaqueSurfaceLayers:
      return {
          .name = "scene.opaque_surface_layers", .geometry = scene_layers_geom, .fragment = scene_layer_surface_frag};
    case SceneEmit::fragmentList:
    case SceneEmit::frontFragmentList:
      return {.name = "scene.fragment_list",
              .geometry = {},
              .fragment = scene_fragment_list_frag,
              .surfaces = Surfaces::all,
              .testsDepth = false,
              .writesDepth = false,
              .frontOnly = emit == SceneEmit::frontFragmentList};
  }
  return {};
}

bool isDrawnBy(SceneEmit emit, AlphaMode mode) {
  const Surfaces surfaces = traitsOf(emit).surfaces;
  return surfaces == Surfaces::all || (surfaces == Surfaces::blended) == (mode == AlphaMode::blend);
}

/// A mirrored object keeps counter-clockwise as the rasterizer's front, for shaders turn its normals round too; so its
/// back is what the rasterizer calls front.
VkCullModeFlags cullModeOf(const SceneViewpoint& viewpoint, const SceneDrawItem& item) {
  if (drawsBothFaces(viewpoint, item)) return VK_CULL_MODE_NONE;
  return item.winding == Winding::turned ? VK_CULL_MODE_FRONT_BIT : VK_CULL_MODE_BACK_BIT;
}

GpuBuffer hostBuffer(const Device& device, VkDeviceSize size, VkBufferUsageFlags usage, const char* name) {
  return makeBuffer(device, size, usage, MemoryKind::upload, name);
}

GpuImage environmentImageOf(const Device& device, const std::optional<Environment>& environment) {
  constexpr VkImageUsageFlags kUsage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  if (environment) {
    auto image = makeImage(device, environment->desc, kUsage, "environment");
    upload(device, image, environment->texels);
    return image;
  }
  auto image =
      makeImage(device, {.format = VK_FORMAT_R16G16B16A16_SFLOAT, .width = 1, .height = 1}, kUsage, "no environment");
  upload(device, image, std::array<std::byte, 8>{});
  return image;
}

}  // namespace

struct SceneRenderer::EmitPipeline {
  SceneEmit emit;
  bool masked;
  bool lit;
  std::vector<VkFormat> colorFormats;
  VkFormat depthFormat;
  VkSampleCountFlagBits samples;
  VkDescriptorSetLayout emitSetLayout = VK_NULL_HANDLE;  ///< Null when the emit binds nothing.
  Unique<VkPipelineLayout> layout;
  Unique<VkPipeline> pipeline;
};

SceneRenderer::SceneRenderer(GraphBackend& backend, const Scene& scene, const std::optional<Environment>& environment)
    : backend_(backend),
      device_(backend.device()),
      gpu_(backend.device(), backend.pipelines(), scene),
      lights_(scene.lights) {
  drawConstants_ = hostBuffer(device_, gpu_.draws().size() * sizeof(shared::DrawConstants),
                              VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, "draw constants");
  lightConstants_ = hostBuffer(device_, lights_.size() * sizeof(shared::LightConstants),
                               VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, "light constants");
  sceneConstants_ =
      hostBuffer(device_, sizeof(shared::SceneConstants), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, "scene constants");
  makeSceneSet(environment);
  setViewpoint({});
}

SceneRenderer::~SceneRenderer() = default;

void SceneRenderer::makeSceneSet(const std::optional<Environment>& environment) {
  environmentImage_ = environmentImageOf(device_, environment);
  if (environment) {
    constants_.hasEnvironment = 1;
    constants_.environmentMips = static_cast<float>(environment->desc.mips);
    for (int i = 0; i < 9; ++i) {
      const auto& c = environment->irradiance[i];
      constants_.irradiance[i] = {c.x, c.y, c.z, 0.0f};
    }
  }
  sceneSetLayout_ = backend_.pipelines().setLayout(kSceneBindings);
  const auto& vk = device_.vk();
  const VkDescriptorPoolSize sizes[] = {{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 3},
                                        {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1},
                                        {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1}};
  VkDescriptorPoolCreateInfo poolInfo{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
  poolInfo.maxSets = 1;
  poolInfo.poolSizeCount = 3;
  poolInfo.pPoolSizes = sizes;
  VkDescriptorPool pool = VK_NULL_HANDLE;
  check(vk.vkCreateDescriptorPool(device_.handle(), &poolInfo, nullptr, &pool), "vkCreateDescriptorPool");
  pool_ = {device_.handle(), pool, vk.vkDestroyDescriptorPool};
  VkDescriptorSetAllocateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
  info.descriptorPool = pool;
  info.descriptorSetCount = 1;
  info.pSetLayouts = &sceneSetLayout_;
  check(vk.vkAllocateDescriptorSets(device_.handle(), &info, &sceneSet_), "vkAllocateDescriptorSets");
  const auto buffer = [](BindingKind kind, VkBuffer handle) {
    return rendergraph::ResolvedBinding{.kind = kind, .buffer = handle};
  };
  const std::array<rendergraph::ResolvedBinding, 5> bindings = {
      buffer(BindingKind::storageBuffer, drawConstants_.buffer.get()),
      buffer(BindingKind::storageBuffer, gpu_.materials()),
      buffer(BindingKind::storageBuffer, lightConstants_.buffer.get()),
      buffer(BindingKind::uniformBuffer, sceneConstants_.buffer.get()),
      rendergraph::ResolvedBinding{.kind = BindingKind::sampledImage,
                                   .view = environmentImage_.view.get(),
                                   .layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
                                   .sampler = {.filter = VK_FILTER_LINEAR,
                                               .mipmap = VK_SAMPLER_MIPMAP_MODE_LINEAR,
                                               .address = VK_SAMPLER_ADDRESS_MODE_REPEAT}}};
  backend_.writeSet(sceneSet_, bindings);
}

void SceneRenderer::setViewpoint(const SceneViewpoint& viewpoint) {
  cullModes_.resize(gpu_.draws().size());
  auto* draws = static_cast<shared::DrawConstants*>(drawConstants_.block.address);
  for (std::size_t i = 0; i < gpu_.draws().size(); ++i) {
    draws[i] = drawConstantsOf(viewpoint, gpu_.draws()[i]);
    cullModes_[i] = cullModeOf(viewpoint, gpu_.draws()[i]);
  }
  auto* lights = static_cast<shared::LightConstants*>(lightConstants_.block.address);
  for (std::size_t i = 0; i < lights_.size(); ++i) lights[i] = lightConstantsOf(viewpoint, lights_[i]);
  lit_ = viewpoint.lit;
  fillViewpoint(constants_, viewpoint);
  constants_.lightCount = static_cast<uint32_t>(lights_.size());
  std::memcpy(sceneConstants_.block.address, &constants_, sizeof constants_);
}

SceneRenderer::EmitPipeline& SceneRenderer::pipelineFor(const SceneDrawRequest& request, bool masked) {
  const std::scoped_lock lock(pipelinesMutex_);
  for (const auto& known : pipelines_) {
    if (known->emit == request.emit && known->masked == masked && known->lit == lit_ &&
        known->samples == request.samples && known->depthFormat == request.depthFormat &&
        std::ranges::equal(known->colorFormats, request.colorFormats)) {
      return *known;
    }
  }
  auto made = std::make_unique<EmitPipeline>();
  made->emit = request.emit;
  made->masked = masked;
  made->lit = lit_;
  made->colorFormats.assign(request.colorFormats.begin(), request.colorFormats.end());
  made->depthFormat = request.depthFormat;
  made->samples = request.samples;
  std::vector<VkDescriptorSetLayout> sets = {sceneSetLayout_, gpu_.materialSetLayout()};
  if (!request.emitBindings.empty()) {
    std::vector<BindingKind> kinds;
    for (const auto& binding : request.emitBindings) kinds.push_back(binding.kind);
    made->emitSetLayout = backend_.pipelines().setLayout(kinds);
    sets.push_back(made->emitSetLayout);
  }
  const VkPushConstantRange range{kAllShaderStages, 0, kPushConstantBytes};
  VkPipelineLayoutCreateInfo layoutInfo{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
  layoutInfo.setLayoutCount = static_cast<uint32_t>(sets.size());
  layoutInfo.pSetLayouts = sets.data();
  layoutInfo.pushConstantRangeCount = 1;
  layoutInfo.pPushConstantRanges = &range;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  check(device_.vk().vkCreatePipelineLayout(device_.handle(), &layoutInfo, nullptr, &layout), "vkCreatePipelineLayout");
  made->layout = {device_.handle(), layout, device_.vk().vkDestroyPipelineLayout};

  const EmitTraits traits = traitsOf(request.emit);
  // Constant 0 of the fragment shaders: whether they may discard, or, for lists, leave out what faces away.
  const bool discards = traits.surfaces == Surfaces::all
                            ? traits.frontOnly
                            : masked || (traits.surfaces == Surfaces::blended && traits.writesDepth);
  const std::array<uint32_t, 2> words = {discards ? VK_TRUE : VK_FALSE, lit_ ? VK_TRUE : VK_FALSE};
  const std::array<VkSpecializationMapEntry, 2> entries = {{{0, 0, sizeof(uint32_t)}, {1, 4, sizeof(uint32_t)}}};
  const VkSpecializationInfo specialization{2, entries.data(), sizeof words, words.data()};
  RasterPipelineDesc desc;
  desc.name = traits.name;
  desc.vertex = scene_scene_vert;
  desc.geometry = traits.geometry;
  desc.fragment = traits.fragment;
  desc.state = {.depthTest = traits.testsDepth, .depthWrite = traits.writesDepth};
  desc.dynamicCull = true;
  desc.specialization = &specialization;
  desc.colorFormats = request.colorFormats;
  desc.depthFormat = request.depthFormat;
  desc.samples = request.samples;
  desc.vertexBindings = {&kVertexBinding, 1};
  desc.vertexAttributes = kAttributes;
  made->pipeline = makeRasterPipeline(device_, backend_.pipelines().cache(), layout, desc);
  pipelines_.push_back(std::move(made));
  return *pipelines_.back();
}

void SceneRenderer::bindFrame(VkCommandBuffer commands, const SceneDrawRequest& request, VkPipelineLayout layout) {
  const auto& vk = device_.vk();
  const VkDeviceSize offset = 0;
  const VkBuffer vertices = gpu_.vertices();
  vk.vkCmdBindVertexBuffers(commands, 0, 1, &vertices, &offset);
  vk.vkCmdBindIndexBuffer(commands, gpu_.indices(), 0, VK_INDEX_TYPE_UINT32);
  const VkViewport viewport{
      0.0f, 0.0f, static_cast<float>(request.extent.width), static_cast<float>(request.extent.height), 0.0f, 1.0f};
  const VkRect2D scissor{{0, 0}, request.extent};
  vk.vkCmdSetViewport(commands, 0, 1, &viewport);
  vk.vkCmdSetScissor(commands, 0, 1, &scissor);
  vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout, 0, 1, &sceneSet_, 0, nullptr);
  vk.vkCmdPushConstants(commands, layout, kAllShaderStages, 0, sizeof request.view, &request.view);
}

void SceneRenderer::draw(const rendergraph::CommandStream& stream, const SceneDrawRequest& request) {
  const auto& vk = device_.vk();
  const VkCommandBuffer commands = stream.buffer;
  const EmitPipeline* bound = nullptr;
  uint32_t boundMaterial = kNoIndex;
  std::optional<VkCullModeFlags> cullMode;
  VkDescriptorSet emitSet = VK_NULL_HANDLE;
  for (uint32_t i = 0; i < gpu_.draws().size(); ++i) {
    const auto& item = gpu_.draws()[i];
    if (!isDrawnBy(request.emit, item.alphaMode) || item.indexCount == 0) continue;
    const auto& pipeline = pipelineFor(request, item.alphaMode == AlphaMode::mask);
    if (bound != &pipeline) {
      if (bound == nullptr) bindFrame(commands, request, pipeline.layout.get());
      vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.pipeline.get());
      bound = &pipeline;
    }
    if (emitSet == VK_NULL_HANDLE && pipeline.emitSetLayout != VK_NULL_HANDLE) {
      emitSet = backend_.transientSet(stream, pipeline.emitSetLayout, request.emitBindings);
      vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.layout.get(), 2, 1, &emitSet, 0,
                                 nullptr);
    }
    if (boundMaterial != item.material) {
      const VkDescriptorSet set = gpu_.materialSet(item.material);
      vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.layout.get(), 1, 1, &set, 0,
                                 nullptr);
      boundMaterial = item.material;
    }
    if (cullMode != cullModes_[i]) {
      cullMode = cullModes_[i];
      vk.vkCmdSetCullMode(commands, *cullMode);
    }
    vk.vkCmdDrawIndexed(commands, item.indexCount, 1, item.firstIndex, item.vertexOffset, i);
  }
}

}  // namespace lensgraph::engine
