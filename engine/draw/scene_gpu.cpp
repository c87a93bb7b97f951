// Turns a scene's meshes, materials and pictures into buffers, images and descriptor sets, and sorts its draws.
#include "engine/draw/scene_gpu.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <tuple>

#include "engine/vulkan/command_buffers.h"
#include "engine/vulkan/vulkan_functions.h"
#include "shaders/shared/scene.h"

namespace lensgraph::engine {
namespace {

SceneVertex vertexOf(const Primitive& primitive, std::size_t i) {
  const auto& p = primitive.positions[i];
  const glm::vec3 n = primitive.normals.empty() ? glm::vec3(0.0f, 0.0f, 1.0f) : primitive.normals[i];
  const glm::vec2 uv0 = primitive.uvs[0].empty() ? glm::vec2(0.0f) : primitive.uvs[0][i];
  const glm::vec2 uv1 = primitive.uvs[1].empty() ? glm::vec2(0.0f) : primitive.uvs[1][i];
  const glm::vec4 c = primitive.colors.empty() ? glm::vec4(1.0f) : primitive.colors[i];
  return {{p.x, p.y, p.z}, {n.x, n.y, n.z}, {uv0.x, uv0.y}, {uv1.x, uv1.y}, {c.x, c.y, c.z, c.w}};
}

/// The use's affine map, read off transformUv() so that its formula stands once.
shared::UvTransform uvTransformOf(const TextureUse& use) {
  const glm::vec2 origin = transformUv(use, {0.0f, 0.0f});
  const glm::vec2 u = transformUv(use, {1.0f, 0.0f}) - origin;
  const glm::vec2 v = transformUv(use, {0.0f, 1.0f}) - origin;
  return {{u.x, v.x, origin.x, static_cast<float>(use.uvSet)}, {u.y, v.y, origin.y, 0.0f}};
}

shared::MaterialConstants constantsOf(const Material& m) {
  shared::MaterialConstants c{};
  c.baseColor = {m.baseColorFactor.x, m.baseColorFactor.y, m.baseColorFactor.z, m.baseColorFactor.w};
  const glm::vec3 emissive = m.emissiveFactor * m.emissiveStrength;
  c.emissive = {emissive.x, emissive.y, emissive.z, m.alphaCutoff};
  c.surface = {m.metallicFactor, m.roughnessFactor, m.normalTexture.isUsed() ? m.normalScale : 0.0f,
               m.occlusionTexture.isUsed() ? m.occlusionStrength : 0.0f};
  c.baseColorUv = uvTransformOf(m.baseColorTexture);
  c.emissiveUv = uvTransformOf(m.emissiveTexture);
  c.metallicRoughnessUv = uvTransformOf(m.metallicRoughnessTexture);
  c.normalUv = uvTransformOf(m.normalTexture);
  c.occlusionUv = uvTransformOf(m.occlusionTexture);
  c.alphaMode = static_cast<uint32_t>(m.alphaMode);
  c.unlit = m.unlit ? 1u : 0u;
  return c;
}

static_assert(static_cast<uint32_t>(AlphaMode::opaque) == shared::kAlphaOpaque);
static_assert(static_cast<uint32_t>(AlphaMode::mask) == shared::kAlphaMask);
static_assert(static_cast<uint32_t>(AlphaMode::blend) == shared::kAlphaBlend);

VkSamplerAddressMode addressModeOf(Wrap wrap) {
  switch (wrap) {
    case Wrap::repeat:
      return VK_SAMPLER_ADDRESS_MODE_REPEAT;
    case Wrap::mirroredRepeat:
      return VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT;
    case Wrap::clampToEdge:
      return VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
  }
  return VK_SAMPLER_ADDRESS_MODE_REPEAT;
}

template <class T>
std::span<const std::byte> bytesOf(const std::vector<T>& items) {
  return std::as_bytes(std::span(items));
}

}  // namespace

Winding windingOf(const glm::dmat4& worldFromObject) {
  constexpr double kRounding = 1e-14;
  // With axes of unit length, so that thin and tiny objects are not taken for flat ones.
  glm::dmat3 m(worldFromObject);
  for (int axis = 0; axis < 3; ++axis) {
    const double largest = std::max({std::abs(m[axis].x), std::abs(m[axis].y), std::abs(m[axis].z)});
    if (largest == 0.0) return Winding::lost;
    m[axis] = glm::normalize(m[axis] / largest);  // Squares of the components themselves could overflow or vanish.
  }
  const double determinant = glm::determinant(m);
  if (!(std::abs(determinant) > kRounding)) return Winding::lost;
  return determinant < 0.0 ? Winding::turned : Winding::kept;
}

SceneGpu::SceneGpu(const Device& device, PipelineStore& pipelines, const Scene& scene) : device_(device) {
  uploadGeometry(scene);
  uploadMaterials(scene);
  uploadImages(scene);
  makeMaterialSets(pipelines, scene);
}

void SceneGpu::uploadGeometry(const Scene& scene) {
  std::vector<SceneVertex> vertices;
  std::vector<uint32_t> indices;
  std::vector<SceneDrawItem> byPrimitive;
  const auto fallback = static_cast<uint32_t>(scene.materials.size());  // the default material, appended
  for (const auto& primitive : scene.primitives) {
    SceneDrawItem item;
    item.firstIndex = static_cast<uint32_t>(indices.size());
    item.indexCount = static_cast<uint32_t>(primitive.indices.size());
    item.vertexOffset = static_cast<int32_t>(vertices.size());
    item.material = primitive.material == kNoIndex ? fallback : primitive.material;
    if (primitive.material != kNoIndex) {
      item.alphaMode = scene.materials[primitive.material].alphaMode;
      item.doubleSided = scene.materials[primitive.material].doubleSided;
    }
    byPrimitive.push_back(item);
    for (std::size_t i = 0; i < primitive.positions.size(); ++i) vertices.push_back(vertexOf(primitive, i));
    indices.insert(indices.end(), primitive.indices.begin(), primitive.indices.end());
  }
  for (const auto& instance : scene.instances) {
    draws_.push_back(byPrimitive[instance.primitive]);
    draws_.back().worldFromObject = instance.worldFromObject;
    draws_.back().winding = windingOf(instance.worldFromObject);
    hasTransparency_ |= draws_.back().alphaMode == AlphaMode::blend;
  }
  std::stable_sort(draws_.begin(), draws_.end(), [](const SceneDrawItem& a, const SceneDrawItem& b) {
    return std::tie(a.alphaMode, a.material, a.winding) < std::tie(b.alphaMode, b.material, b.winding);
  });
  using rendergraph::MemoryKind;
  vertices_ = makeBuffer(device_, vertices.size() * sizeof(SceneVertex),
                         VK_BUFFER_USAGE_VERTEX_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryKind::device,
                         "scene vertices");
  indices_ = makeBuffer(device_, indices.size() * sizeof(uint32_t),
                        VK_BUFFER_USAGE_INDEX_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryKind::device,
                        "scene indices");
  upload(device_, vertices_, bytesOf(vertices));
  upload(device_, indices_, bytesOf(indices));
}

void SceneGpu::uploadMaterials(const Scene& scene) {
  std::vector<shared::MaterialConstants> constants;
  for (const auto& material : scene.materials) constants.push_back(constantsOf(material));
  constants.push_back(constantsOf(Material{}));
  materials_ = makeBuffer(device_, constants.size() * sizeof(constants[0]),
                          VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                          rendergraph::MemoryKind::device, "scene materials");
  upload(device_, materials_, bytesOf(constants));
}

void SceneGpu::uploadImages(const Scene& scene) {
  constexpr VkImageUsageFlags kUsage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  const auto add = [&](uint32_t width, uint32_t height, bool srgb, std::span<const std::byte> texels,
                       const std::string& name) {
    const VkFormat format = srgb ? VK_FORMAT_R8G8B8A8_SRGB : VK_FORMAT_R8G8B8A8_UNORM;
    images_.push_back(makeImage(device_, {.format = format, .width = width, .height = height}, kUsage, name));
    upload(device_, images_.back(), texels);
  };
  for (const auto& image : scene.images) {
    add(image.width, image.height, image.encoding == ColorEncoding::srgb, bytesOf(image.rgba), image.name);
  }
  const std::array<std::byte, 4> white = {std::byte{255}, std::byte{255}, std::byte{255}, std::byte{255}};
  add(1, 1, false, white, "white");
}

VkSampler SceneGpu::samplerFor(const Texture& texture) {
  VkSamplerCreateInfo info{VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO};
  // Level 0 only (shaders ask for it): the magnification filter decides.
  info.magFilter = texture.magFilter == Filter::nearest ? VK_FILTER_NEAREST : VK_FILTER_LINEAR;
  info.minFilter = info.magFilter;
  info.addressModeU = addressModeOf(texture.wrapS);
  info.addressModeV = addressModeOf(texture.wrapT);
  for (const auto& [known, sampler] : samplers_) {
    if (known.magFilter == info.magFilter && known.addressModeU == info.addressModeU &&
        known.addressModeV == info.addressModeV) {
      return sampler.get();
    }
  }
  VkSampler sampler = VK_NULL_HANDLE;
  check(device_.vk().vkCreateSampler(device_.handle(), &info, nullptr, &sampler), "vkCreateSampler");
  samplers_.emplace_back(info, Unique<VkSampler>(device_.handle(), sampler, device_.vk().vkDestroySampler));
  return sampler;
}

void SceneGpu::makeMaterialSets(PipelineStore& pipelines, const Scene& scene) {
  const auto& vk = device_.vk();
  const std::array<BindingKind, kMaterialTextures> kinds = {BindingKind::sampledImage, BindingKind::sampledImage,
                                                            BindingKind::sampledImage, BindingKind::sampledImage,
                                                            BindingKind::sampledImage};
  materialSetLayout_ = pipelines.setLayout(kinds);
  const auto count = static_cast<uint32_t>(scene.materials.size() + 1);
  const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, count * kMaterialTextures};
  VkDescriptorPoolCreateInfo poolInfo{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
  poolInfo.maxSets = count;
  poolInfo.poolSizeCount = 1;
  poolInfo.pPoolSizes = &size;
  VkDescriptorPool pool = VK_NULL_HANDLE;
  check(vk.vkCreateDescriptorPool(device_.handle(), &poolInfo, nullptr, &pool), "vkCreateDescriptorPool");
  pool_ = {device_.handle(), pool, vk.vkDestroyDescriptorPool};
  const std::vector<VkDescriptorSetLayout> layouts(count, materialSetLayout_);
  VkDescriptorSetAllocateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
  info.descriptorPool = pool;
  info.descriptorSetCount = count;
  info.pSetLayouts = layouts.data();
  materialSets_.resize(count);
  check(vk.vkAllocateDescriptorSets(device_.handle(), &info, materialSets_.data()), "vkAllocateDescriptorSets");

  for (uint32_t m = 0; m < count; ++m) {
    const Material material = m < scene.materials.size() ? scene.materials[m] : Material{};
    const TextureUse* uses[kMaterialTextures] = {&material.baseColorTexture, &material.emissiveTexture,
                                                 &material.metallicRoughnessTexture, &material.normalTexture,
                                                 &material.occlusionTexture};
    std::array<VkDescriptorImageInfo, kMaterialTextures> images;
    for (uint32_t i = 0; i < kMaterialTextures; ++i) {
      const Texture texture = uses[i]->isUsed() ? scene.textures[uses[i]->texture] : Texture{};
      const auto& image = texture.image == kNoIndex ? images_.back() : images_[texture.image];
      images[i] = {samplerFor(texture), image.view.get(), VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    }
    VkWriteDescriptorSet write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
    std::array<VkWriteDescriptorSet, kMaterialTextures> writes;
    for (uint32_t i = 0; i < kMaterialTextures; ++i) {
      write.dstSet = materialSets_[m];
      write.dstBinding = i;
      write.descriptorCount = 1;
      write.descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
      write.pImageInfo = &images[i];
      writes[i] = write;
    }
    vk.vkUpdateDescriptorSets(device_.handle(), kMaterialTextures, writes.data(), 0, nullptr);
  }
}

}  // namespace lensgraph::engine
