// Accessors to plain arrays. Every byte range is checked here, once, before it is read: nothing else reads
// buffers.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "engine/gltf/internal.h"

namespace lensgraph::engine::gltf {
namespace {

// An accessor without a buffer view is all zeros, so a tiny file can claim any size: more than this is no
// scene.
constexpr size_t kMaxZeroElements = size_t{1} << 24;

size_t componentSize(int componentType) {
  switch (componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return 4;
    default:
      return 0;
  }
}

// Copies `count` elements that stand `stride` apart into `target`, tightly packed.
void copyElements(const Document& document, std::span<const uint8_t> source, size_t offset, size_t stride,
                  size_t elementSize, size_t count, const std::string& place, std::vector<uint8_t>& target) {
  if (count == 0) return;
  if (stride < elementSize) {
    document.fail(place, "byteStride " + std::to_string(stride) + " is smaller than an element of " +
                             std::to_string(elementSize));
  }
  // Divisions instead of products: counts from the file may overflow.
  const bool fits = offset <= source.size() && elementSize <= source.size() - offset &&
                    count - 1 <= (source.size() - offset - elementSize) / stride;
  if (!fits) {
    document.fail(place, "reaches past the end of its buffer view: " + std::to_string(count) + " elements from byte " +
                             std::to_string(offset) + ", the view has " + std::to_string(source.size()) + " bytes");
  }
  target.resize(count * elementSize);
  for (size_t i = 0; i < count; ++i) {
    std::memcpy(target.data() + i * elementSize, source.data() + offset + i * stride, elementSize);
  }
}

// Unaligned little-endian reads; the platforms of the project are little-endian.
template <typename T>
T valueAt(const std::vector<uint8_t>& bytes, size_t index) {
  T value;
  std::memcpy(&value, bytes.data() + index * sizeof(T), sizeof(T));
  return value;
}

uint32_t unsignedAt(const std::vector<uint8_t>& bytes, size_t index, int componentType) {
  switch (componentType) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return valueAt<uint8_t>(bytes, index);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return valueAt<uint16_t>(bytes, index);
    default:
      return valueAt<uint32_t>(bytes, index);
  }
}

bool isUnsignedType(int componentType) {
  return componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
         componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
         componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

void applySparse(const Document& document, const tinygltf::Accessor& accessor, size_t elementSize,
                 const std::string& place, std::vector<uint8_t>& bytes) {
  const auto& sparse = accessor.sparse;
  const auto offsetOf = [](int byteOffset) { return static_cast<size_t>(std::max(byteOffset, 0)); };
  if (sparse.count < 0 || static_cast<size_t>(sparse.count) > accessor.count) {
    document.fail(place + ".sparse.count", "is larger than the accessor's count");
  }
  const size_t count = static_cast<size_t>(sparse.count);
  if (!isUnsignedType(sparse.indices.componentType)) {
    document.fail(place + ".sparse.indices.componentType",
                  std::to_string(sparse.indices.componentType) + " is no unsigned integer type");
  }
  const size_t indexSize = componentSize(sparse.indices.componentType);
  std::vector<uint8_t> indices, values;
  copyElements(document, viewBytes(document, sparse.indices.bufferView), offsetOf(sparse.indices.byteOffset), indexSize,
               indexSize, count, place + ".sparse.indices", indices);
  copyElements(document, viewBytes(document, sparse.values.bufferView), offsetOf(sparse.values.byteOffset), elementSize,
               elementSize, count, place + ".sparse.values", values);
  for (size_t i = 0; i < count; ++i) {
    const uint32_t index = unsignedAt(indices, i, sparse.indices.componentType);
    if (index >= accessor.count) {
      document.fail(place + ".sparse.indices", "index " + std::to_string(index) +
                                                   " is out of range: the accessor has " +
                                                   std::to_string(accessor.count) + " elements");
    }
    std::memcpy(bytes.data() + index * elementSize, values.data() + i * elementSize, elementSize);
  }
}

// The elements of an accessor, tightly packed, sparse values in place.
std::vector<uint8_t> packedBytes(const Document& document, int index, int components) {
  const tinygltf::Accessor& accessor = document.model.accessors[static_cast<size_t>(index)];
  const std::string place = at("accessors", static_cast<size_t>(index));
  const size_t size = componentSize(accessor.componentType);
  if (size == 0)
    document.fail(place + ".componentType", std::to_string(accessor.componentType) + " is no component type of glTF");
  const size_t elementSize = size * static_cast<size_t>(components);
  std::vector<uint8_t> bytes;
  if (accessor.bufferView >= 0) {
    const size_t stride = document.model.bufferViews[static_cast<size_t>(accessor.bufferView)].byteStride;
    copyElements(document, viewBytes(document, accessor.bufferView), accessor.byteOffset,
                 stride != 0 ? stride : elementSize, elementSize, accessor.count, place, bytes);
  } else {
    if (accessor.count > kMaxZeroElements)
      document.fail(place + ".count", "is too large for an accessor without bufferView");
    bytes.assign(accessor.count * elementSize, 0);
  }
  if (accessor.sparse.isSparse) applySparse(document, accessor, elementSize, place, bytes);
  return bytes;
}

// glTF 2.0 §3.6.2.2 for normalised integers; others stand for themselves.
template <typename T>
void convert(const std::vector<uint8_t>& bytes, bool isNormalized, std::vector<float>& values) {
  const float divisor = isNormalized ? static_cast<float>(std::numeric_limits<T>::max()) : 1.0f;
  const float least = isNormalized ? -1.0f : std::numeric_limits<float>::lowest();
  for (size_t i = 0; i < values.size(); ++i)
    values[i] = std::max(static_cast<float>(valueAt<T>(bytes, i)) / divisor, least);
}

// Which bit of ComponentTypes an accessor needs; 0 when no attribute may be of that type.
unsigned neededType(const tinygltf::Accessor& accessor) {
  switch (accessor.componentType) {
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return kFloat;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return accessor.normalized ? kNormalizedUnsigned : kPlainInteger;
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return accessor.normalized ? kNormalizedSigned : kPlainInteger;
    default:
      return 0;
  }
}

void requireComponents(const Document& document, const tinygltf::Accessor& accessor, int components,
                       const std::string& field) {
  const int found = accessor.type == TINYGLTF_TYPE_SCALAR ? 1
                    : accessor.type == TINYGLTF_TYPE_MAT4 ? 16
                                                          : componentCount(accessor);
  if (found != components) {
    document.fail(field,
                  "its accessor has " + std::to_string(found) + " components instead of " + std::to_string(components));
  }
}

}  // namespace

int componentCount(const tinygltf::Accessor& accessor) {
  switch (accessor.type) {
    case TINYGLTF_TYPE_VEC2:
      return 2;
    case TINYGLTF_TYPE_VEC3:
      return 3;
    case TINYGLTF_TYPE_VEC4:
      return 4;
    default:
      return 0;
  }
}

std::span<const uint8_t> viewBytes(const Document& document, int bufferView) {
  const tinygltf::BufferView& view = document.model.bufferViews[static_cast<size_t>(bufferView)];
  const std::vector<uint8_t>& data = document.model.buffers[static_cast<size_t>(view.buffer)].data;
  if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset) {
    document.fail(at("bufferViews", static_cast<size_t>(bufferView)),
                  "bytes " + std::to_string(view.byteOffset) + " + " + std::to_string(view.byteLength) +
                      " are outside its buffer of " + std::to_string(data.size()));
  }
  return std::span(data).subspan(view.byteOffset, view.byteLength);
}

std::vector<float> readFloats(const Document& document, int accessorIndex, int components, unsigned allowedTypes,
                              const std::string& field) {
  const tinygltf::Accessor& accessor = document.model.accessors[static_cast<size_t>(accessorIndex)];
  requireComponents(document, accessor, components, field);
  if ((neededType(accessor) & allowedTypes) == 0) {
    document.fail(field, "its accessor's component type " + std::to_string(accessor.componentType) +
                             (accessor.normalized ? " (normalized)" : "") + " is not allowed here");
  }
  const std::vector<uint8_t> bytes = packedBytes(document, accessorIndex, components);
  std::vector<float> values(accessor.count * static_cast<size_t>(components));
  switch (accessor.componentType) {
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      if (!bytes.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
      break;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      convert<uint8_t>(bytes, accessor.normalized, values);
      break;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      convert<uint16_t>(bytes, accessor.normalized, values);
      break;
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      convert<int8_t>(bytes, accessor.normalized, values);
      break;
    default:
      convert<int16_t>(bytes, accessor.normalized, values);
      break;
  }
  const auto bad = std::find_if(values.begin(), values.end(), [](float v) { return !std::isfinite(v); });
  if (bad != values.end()) {
    const auto element = (bad - values.begin()) / components;
    document.fail(field, "element " + std::to_string(element) + " is not finite (NaN or infinite)");
  }
  return values;
}

std::vector<uint32_t> readUnsigned(const Document& document, int accessorIndex, int components,
                                   const std::string& field) {
  const tinygltf::Accessor& accessor = document.model.accessors[static_cast<size_t>(accessorIndex)];
  requireComponents(document, accessor, components, field);
  if (!isUnsignedType(accessor.componentType) || accessor.normalized) {
    document.fail(field, "its accessor is not of plain unsigned integers");
  }
  const std::vector<uint8_t> bytes = packedBytes(document, accessorIndex, components);
  std::vector<uint32_t> values(accessor.count * static_cast<size_t>(components));
  for (size_t i = 0; i < values.size(); ++i) values[i] = unsignedAt(bytes, i, accessor.componentType);
  return values;
}

}  // namespace lensgraph::engine::gltf
