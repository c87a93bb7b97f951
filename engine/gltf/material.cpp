// Builds materials, textures and samplers.
#include "engine/gltf/material.h"

#include <algorithm>
#include <array>

namespace lensgraph::engine::gltf {
namespace {

Wrap wrapOf(const Document& document, int value, const std::string& field) {
  switch (value) {
    case TINYGLTF_TEXTURE_WRAP_REPEAT:
      return Wrap::repeat;
    case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
      return Wrap::mirroredRepeat;
    case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
      return Wrap::clampToEdge;
    default:
      document.fail(field, std::to_string(value) + " is no wrap mode");
  }
}

void setFilters(const Document& document, const tinygltf::Sampler& sampler, const std::string& field,
                Texture& texture) {
  switch (sampler.magFilter) {
    case -1:
    case TINYGLTF_TEXTURE_FILTER_LINEAR:
      texture.magFilter = Filter::linear;
      break;
    case TINYGLTF_TEXTURE_FILTER_NEAREST:
      texture.magFilter = Filter::nearest;
      break;
    default:
      document.fail(field + ".magFilter", std::to_string(sampler.magFilter) + " is no magnification filter");
  }
  const auto set = [&](Filter minFilter, std::optional<Filter> mipFilter) {
    texture.minFilter = minFilter;
    texture.mipFilter = mipFilter;
  };
  switch (sampler.minFilter) {
    case TINYGLTF_TEXTURE_FILTER_NEAREST:
      return set(Filter::nearest, std::nullopt);
    case TINYGLTF_TEXTURE_FILTER_LINEAR:
      return set(Filter::linear, std::nullopt);
    case TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST:
      return set(Filter::nearest, Filter::nearest);
    case TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_NEAREST:
      return set(Filter::linear, Filter::nearest);
    case TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_LINEAR:
      return set(Filter::nearest, Filter::linear);
    case -1:
    case TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR:
      return set(Filter::linear, Filter::linear);
    default:
      document.fail(field + ".minFilter", std::to_string(sampler.minFilter) + " is no minification filter");
  }
}

AlphaMode alphaModeOf(const Document& document, const std::string& mode, const std::string& field) {
  if (mode == "OPAQUE") return AlphaMode::opaque;
  if (mode == "MASK") return AlphaMode::mask;
  if (mode == "BLEND") return AlphaMode::blend;
  document.fail(field, "'" + mode + "' is none of OPAQUE, MASK, BLEND");
}

// Of glass that lets all light through this much is still drawn, so that its reflections show: the 4 % that each of the
// two sides of a pane reflects.
constexpr float kLeastGlassAlpha = 0.08f;

std::array<TextureUse*, 5> textureUsesOf(Material& material) {
  return {&material.baseColorTexture, &material.emissiveTexture, &material.metallicRoughnessTexture,
          &material.normalTexture, &material.occlusionTexture};
}

// Members of an extension are numbers and arrays of the right length: the document has been checked.
double numberIn(const tinygltf::Value& object, const char* member, double otherwise) {
  return object.Has(member) ? object.Get(member).GetNumberAsDouble() : otherwise;
}

glm::vec2 vec2In(const Document& document, const tinygltf::Value& object, const char* member, glm::vec2 otherwise,
                 const std::string& field) {
  if (!object.Has(member)) return otherwise;
  const tinygltf::Value& value = object.Get(member);
  return {toFloat(document, value.Get(0).GetNumberAsDouble(), field + "." + member),
          toFloat(document, value.Get(1).GetNumberAsDouble(), field + "." + member)};
}

}  // namespace

MaterialBuilder::MaterialBuilder(Document& document, Scene& scene, bool isLit)
    : document_(document), scene_(scene), isLit_(isLit), images_(document) {
  materials_.assign(document.model.materials.size() + 1, kNoIndex);
  uvSets_.assign(document.model.materials.size() + 1, UvSets{0, 1});
  for (auto& textures : textures_) textures.assign(document.model.textures.size(), kNoIndex);
  for (auto& images : imageIndices_) images.assign(document.model.images.size(), kNoIndex);
}

uint32_t MaterialBuilder::materialIndex(int material) {
  uint32_t& index = materials_[static_cast<size_t>(material + 1)];
  if (index == kNoIndex) {
    Material built = material < 0 ? Material{} : build(static_cast<size_t>(material));
    if (material >= 0) uvSets_[static_cast<size_t>(material + 1)] = placeUvSets(static_cast<size_t>(material), built);
    index = static_cast<uint32_t>(scene_.materials.size());
    scene_.materials.push_back(std::move(built));
  }
  return index;
}

Material MaterialBuilder::build(size_t index) {
  const tinygltf::Material& source = document_.model.materials[index];
  const std::string field = at("materials", index);
  const auto number = [&](double value, const char* member) { return toFloat(document_, value, field + member); };
  Material material;
  material.name = source.name;
  material.alphaMode = alphaModeOf(document_, source.alphaMode, field + ".alphaMode");
  material.alphaCutoff = number(source.alphaCutoff, ".alphaCutoff");
  material.doubleSided = source.doubleSided;
  material.unlit = source.extensions.contains("KHR_materials_unlit");

  const tinygltf::PbrMetallicRoughness& pbr = source.pbrMetallicRoughness;
  for (int c = 0; c < 4; ++c) {
    material.baseColorFactor[c] =
        number(pbr.baseColorFactor[static_cast<size_t>(c)], ".pbrMetallicRoughness.baseColorFactor");
  }
  material.baseColorTexture =
      use(pbr.baseColorTexture, ColorEncoding::srgb, field + ".pbrMetallicRoughness.baseColorTexture");
  material.metallicFactor = number(pbr.metallicFactor, ".pbrMetallicRoughness.metallicFactor");
  material.roughnessFactor = number(pbr.roughnessFactor, ".pbrMetallicRoughness.roughnessFactor");
  // The picture of an unlit material is its base colour alone, so the rest is neither kept nor decoded.
  if (material.unlit) return material;

  for (int c = 0; c < 3; ++c)
    material.emissiveFactor[c] = number(source.emissiveFactor[static_cast<size_t>(c)], ".emissiveFactor");
  if (const auto found = source.extensions.find("KHR_materials_emissive_strength"); found != source.extensions.end()) {
    material.emissiveStrength = number(numberIn(found->second, "emissiveStrength", 1.0),
                                       ".extensions.KHR_materials_emissive_strength.emissiveStrength");
  }
  const bool isEmissive = material.emissiveFactor != glm::vec3(0.0f) && material.emissiveStrength != 0.0f;
  if (isEmissive)
    material.emissiveTexture = use(source.emissiveTexture, ColorEncoding::srgb, field + ".emissiveTexture");
  const auto transmission = source.extensions.find("KHR_materials_transmission");
  if (transmission != source.extensions.end()) addTransmission(transmission->second, field, material);
  if (!isLit_) return material;

  material.metallicRoughnessTexture = use(pbr.metallicRoughnessTexture, ColorEncoding::linear,
                                          field + ".pbrMetallicRoughness.metallicRoughnessTexture");
  material.normalTexture = use(source.normalTexture, ColorEncoding::linear, field + ".normalTexture");
  material.normalScale = number(source.normalTexture.scale, ".normalTexture.scale");
  material.occlusionTexture = use(source.occlusionTexture, ColorEncoding::linear, field + ".occlusionTexture");
  material.occlusionStrength = number(source.occlusionTexture.strength, ".occlusionTexture.strength");
  return material;
}

void MaterialBuilder::addTransmission(const tinygltf::Value& transmission, const std::string& field,
                                      Material& material) {
  const float factor = toFloat(document_, numberIn(transmission, "transmissionFactor", 0.0),
                               field + ".extensions.KHR_materials_transmission.transmissionFactor");
  if (!(factor > 0.0f)) return;
  if (!isLit_) {
    document_.warn("KHR_materials_transmission is ignored in unlit pictures", field);
    return;
  }
  document_.warn("KHR_materials_transmission is drawn as alpha, without refraction", field);
  if (transmission.Has("transmissionTexture"))
    document_.warn("the texture of KHR_materials_transmission is left out", field);
  if (material.alphaMode == AlphaMode::opaque) material.baseColorFactor.a = 1.0f;
  material.baseColorFactor.a *= std::max(1.0f - factor, kLeastGlassAlpha);
  material.alphaMode = AlphaMode::blend;
}

UvSets MaterialBuilder::placeUvSets(size_t index, Material& material) {
  std::vector<uint32_t> sets;
  for (TextureUse* use : textureUsesOf(material)) {
    if (use->isUsed() && std::find(sets.begin(), sets.end(), use->uvSet) == sets.end()) sets.push_back(use->uvSet);
  }
  UvSets placed{0, 1};
  if (std::all_of(sets.begin(), sets.end(), [](uint32_t set) { return set <= 1; })) return placed;
  if (sets.size() > placed.size()) {
    document_.warn("a material uses more than two UV sets, the textures with the others are left out",
                   at("materials", index));
    sets.resize(placed.size());
  }
  placed[0] = sets[0];
  // With one set the second slot holds nothing that is used.
  placed[1] = sets.size() > 1 ? sets[1] : placed[0] == 0 ? 1 : 0;
  for (TextureUse* use : textureUsesOf(material)) {
    if (!use->isUsed()) continue;
    const auto slot = std::find(sets.begin(), sets.end(), use->uvSet);
    if (slot == sets.end()) {
      *use = TextureUse{};
    } else {
      use->uvSet = static_cast<uint32_t>(slot - sets.begin());
    }
  }
  return placed;
}

template <typename TextureInfo>
TextureUse MaterialBuilder::use(const TextureInfo& info, ColorEncoding encoding, const std::string& field) {
  TextureUse result;
  if (info.index < 0) return result;
  double uvSet = info.texCoord;
  if (const auto found = info.extensions.find("KHR_texture_transform"); found != info.extensions.end()) {
    const tinygltf::Value& transform = found->second;
    const std::string transformField = field + ".extensions.KHR_texture_transform";
    result.offset = vec2In(document_, transform, "offset", result.offset, transformField);
    result.scale = vec2In(document_, transform, "scale", result.scale, transformField);
    result.rotation = toFloat(document_, numberIn(transform, "rotation", 0.0), transformField + ".rotation");
    uvSet = numberIn(transform, "texCoord", uvSet);
  }
  result.uvSet = static_cast<uint32_t>(uvSet);
  result.texture = textureIndex(info.index, encoding);
  return result;
}

uint32_t MaterialBuilder::textureIndex(int texture, ColorEncoding encoding) {
  uint32_t& index = textures_[static_cast<size_t>(encoding)][static_cast<size_t>(texture)];
  if (index != kNoIndex) return index;
  const tinygltf::Texture& source = document_.model.textures[static_cast<size_t>(texture)];
  if (source.source < 0) failWithoutSource(static_cast<size_t>(texture));
  Texture result;
  if (source.sampler >= 0) {
    const tinygltf::Sampler& sampler = document_.model.samplers[static_cast<size_t>(source.sampler)];
    const std::string field = at("samplers", static_cast<size_t>(source.sampler));
    result.wrapS = wrapOf(document_, sampler.wrapS, field + ".wrapS");
    result.wrapT = wrapOf(document_, sampler.wrapT, field + ".wrapT");
    setFilters(document_, sampler, field, result);
  }
  result.image = imageIndex(source.source, encoding);
  index = static_cast<uint32_t>(scene_.textures.size());
  scene_.textures.push_back(result);
  return index;
}

void MaterialBuilder::failWithoutSource(size_t texture) const {
  const std::string remedy = "export with PNG or JPEG textures";
  const tinygltf::ExtensionMap& extensions = document_.model.textures[texture].extensions;
  if (extensions.empty()) document_.fail(at("textures", texture, ".source"), "is missing", remedy);
  document_.fail(at("textures", texture), "has its image in " + extensions.begin()->first + " alone, which is not read",
                 remedy);
}

uint32_t MaterialBuilder::imageIndex(int image, ColorEncoding encoding) {
  uint32_t& index = imageIndices_[static_cast<size_t>(encoding)][static_cast<size_t>(image)];
  if (index != kNoIndex) return index;
  const uint32_t other = imageIndices_[1 - static_cast<size_t>(encoding)][static_cast<size_t>(image)];
  SceneImage decoded = other != kNoIndex ? images_.copy(scene_.images[other], image) : images_.decode(image);
  decoded.encoding = encoding;
  index = static_cast<uint32_t>(scene_.images.size());
  scene_.images.push_back(std::move(decoded));
  return index;
}

}  // namespace lensgraph::engine::gltf
