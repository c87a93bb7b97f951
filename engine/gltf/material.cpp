// Materials, textures, samplers and images of a glTF file.
#include <algorithm>
#include <climits>
#include <cmath>
#include <limits>

#include "engine/gltf/internal.h"

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

bool isPngOrJpeg(std::span<const uint8_t> bytes) {
  const auto startsWith = [&](std::initializer_list<uint8_t> magic) {
    return bytes.size() >= magic.size() && std::equal(magic.begin(), magic.end(), bytes.begin());
  };
  return startsWith({0x89, 'P', 'N', 'G'}) || startsWith({0xFF, 0xD8, 0xFF});
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

float toFloat(const Document& document, double value, const std::string& field) {
  if (!(std::fabs(value) <= double{std::numeric_limits<float>::max()})) document.fail(field, "is too large");
  return static_cast<float>(value);
}

SceneImage decodeImage(const Document& document, int index, ColorEncoding encoding) {
  const tinygltf::Image& source = document.model.images[static_cast<size_t>(index)];
  const std::string field = at("images", static_cast<size_t>(index));
  std::vector<uint8_t> external;
  std::span<const uint8_t> bytes;
  if (source.bufferView >= 0) {
    bytes = viewBytes(document, source.bufferView);
  } else {
    if (source.uri.empty()) document.fail(field, "has neither uri nor bufferView");
    external = readUri(document, source.uri, field + ".uri");
    bytes = external;
  }
  const bool isShortUri = !source.uri.empty() && !source.uri.starts_with("data:");
  const std::string name = isShortUri ? "'" + source.uri + "' " : std::string();
  if (bytes.empty()) document.fail(field, name + "is empty (0 bytes)");
  // Only what glTF allows: the decoder's other formats have seen less care.
  if (!isPngOrJpeg(bytes)) document.fail(field, name + "is neither PNG nor JPEG", "convert it to PNG");
  if (bytes.size() > static_cast<size_t>(INT_MAX)) document.fail(field, name + "is too large");

  tinygltf::Image decoded;
  std::string errors, warnings;
  if (!tinygltf::LoadImageData(&decoded, index, &errors, &warnings, 0, 0, bytes.data(), static_cast<int>(bytes.size()),
                               nullptr)) {
    document.fail(field, name + "is damaged and cannot be decoded");
  }
  SceneImage image;
  image.name = isShortUri ? source.uri : source.name.empty() ? field : source.name;
  image.width = static_cast<uint32_t>(decoded.width);
  image.height = static_cast<uint32_t>(decoded.height);
  image.encoding = encoding;
  const size_t count = size_t{image.width} * image.height * 4;
  if (decoded.bits == 16 && decoded.image.size() == 2 * count) {
    image.rgba.resize(count);
    for (size_t i = 0; i < count; ++i) {
      const uint32_t value = decoded.image[2 * i] | uint32_t{decoded.image[2 * i + 1]} << 8;
      image.rgba[i] = static_cast<uint8_t>((value * 255 + 32767) / 65535);
    }
  } else {
    image.rgba = std::move(decoded.image);
  }
  if (image.rgba.size() != count || count == 0) document.fail(field, name + "has an unexpected pixel format");
  return image;
}

MaterialBuilder::MaterialBuilder(Document& document, Scene& scene, bool loadShadingTextures)
    : document_(document), scene_(scene), loadShadingTextures_(loadShadingTextures) {
  materials_.assign(document.model.materials.size() + 1, kNoIndex);
  for (auto& textures : textures_) textures.assign(document.model.textures.size(), kNoIndex);
  for (auto& images : images_) images.assign(document.model.images.size(), kNoIndex);
}

uint32_t MaterialBuilder::materialIndex(int material) {
  uint32_t& index = materials_[static_cast<size_t>(material + 1)];
  if (index == kNoIndex) {
    Material built = material < 0 ? Material{} : build(static_cast<size_t>(material));
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
  if (!loadShadingTextures_) return material;

  material.metallicRoughnessTexture = use(pbr.metallicRoughnessTexture, ColorEncoding::linear,
                                          field + ".pbrMetallicRoughness.metallicRoughnessTexture");
  material.normalTexture = use(source.normalTexture, ColorEncoding::linear, field + ".normalTexture");
  material.normalScale = number(source.normalTexture.scale, ".normalTexture.scale");
  material.occlusionTexture = use(source.occlusionTexture, ColorEncoding::linear, field + ".occlusionTexture");
  material.occlusionStrength = number(source.occlusionTexture.strength, ".occlusionTexture.strength");
  return material;
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
  if (!(uvSet == 0.0 || uvSet == 1.0)) {
    document_.warn(field + ": UV sets above 1 are not read, the texture is left out");
    return TextureUse{};
  }
  result.uvSet = static_cast<uint32_t>(uvSet);
  result.texture = textureIndex(info.index, encoding);
  return result;
}

uint32_t MaterialBuilder::textureIndex(int texture, ColorEncoding encoding) {
  uint32_t& index = textures_[static_cast<size_t>(encoding)][static_cast<size_t>(texture)];
  if (index != kNoIndex) return index;
  const tinygltf::Texture& source = document_.model.textures[static_cast<size_t>(texture)];
  if (source.source < 0) {
    document_.fail(at("textures", static_cast<size_t>(texture), ".source"), "is missing",
                   "export with PNG or JPEG textures");
  }
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

uint32_t MaterialBuilder::imageIndex(int image, ColorEncoding encoding) {
  uint32_t& index = images_[static_cast<size_t>(encoding)][static_cast<size_t>(image)];
  if (index != kNoIndex) return index;
  const uint32_t other = images_[1 - static_cast<size_t>(encoding)][static_cast<size_t>(image)];
  SceneImage decoded;
  if (other != kNoIndex) {
    decoded = scene_.images[other];
    decoded.encoding = encoding;
  } else {
    decoded = decodeImage(document_, image, encoding);
  }
  index = static_cast<uint32_t>(scene_.images.size());
  scene_.images.push_back(std::move(decoded));
  return index;
}

}  // namespace lensgraph::engine::gltf
