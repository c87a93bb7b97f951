// Reads accessors: ranges, strides, sparse values, component types.
#include "engine/gltf/geometry/accessor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

namespace lensgraph::engine::gltf {
namespace {

// What accessors without a buffer view are made of: an element of the largest size.
constexpr std::array<uint8_t, 64> kZeros{};

// Throws unless `count` elements that stand `stride` apart lie inside a view.
void requireInside(const Document& document, std::span<const uint8_t> view, size_t offset, size_t stride,
                   size_t elementSize, size_t count, const std::string& place) {
  if (count == 0) return;
  if (stride < elementSize) {
    document.fail(place, "byteStride " + std::to_string(stride) + " is smaller than an element of " +
                             std::to_string(elementSize));
  }
  // Divisions instead of products: counts from the file may overflow.
  const bool fits = offset <= view.size() && elementSize <= view.size() - offset &&
                    count - 1 <= (view.size() - offset - elementSize) / stride;
  if (!fits) {
    document.fail(place, "reaches past the end of its buffer view: " + std::to_string(count) + " elements from byte " +
                             std::to_string(offset) + ", the view has " + std::to_string(view.size()) + " bytes");
  }
}

// Unaligned little-endian reads; the platforms of the project are little-endian.
template <typename T>
T valueAt(const uint8_t* bytes, size_t index) {
  T value;
  std::memcpy(&value, bytes + index * sizeof(T), sizeof(T));
  return value;
}

uint32_t unsignedAt(const uint8_t* bytes, size_t index, int componentType) {
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

// Puts the elements together in `packed`, with the sparse ones in place.
void applySparse(Document& document, const tinygltf::Accessor& accessor, const std::string& place, Elements& elements) {
  const auto& sparse = accessor.sparse;
  const size_t elementSize = elements.elementSize();
  if (static_cast<size_t>(sparse.count) > accessor.count)
    document.fail(place + ".sparse.count", "is larger than the accessor's count");
  const size_t count = static_cast<size_t>(sparse.count);
  if (!isUnsignedType(sparse.indices.componentType)) {
    document.fail(place + ".sparse.indices.componentType",
                  std::to_string(sparse.indices.componentType) + " is no unsigned integer type");
  }
  const auto viewOf = [&](const auto& part, size_t size, const char* name) {
    const auto view = document.buffers.viewBytes(part.bufferView);
    requireInside(document, view, static_cast<size_t>(part.byteOffset), size, size, count, place + name);
    return view.data() + part.byteOffset;
  };
  const uint8_t* indices = viewOf(sparse.indices, componentSize(sparse.indices.componentType), ".sparse.indices");
  const uint8_t* values = viewOf(sparse.values, elementSize, ".sparse.values");

  // No product overflows: counts are below 2^53.
  document.takeMemory(accessor.count * elementSize, (elements.isStored ? accessor.count : count) * elementSize,
                      place + ".count");
  std::vector<uint8_t> packed(accessor.count * elementSize);
  for (size_t i = 0; i < accessor.count; ++i)
    std::memcpy(packed.data() + i * elementSize, elements.first + i * elements.stride, elementSize);
  for (size_t i = 0; i < count; ++i) {
    const uint32_t index = unsignedAt(indices, i, sparse.indices.componentType);
    if (index >= accessor.count) {
      document.fail(place + ".sparse.indices", "index " + std::to_string(index) +
                                                   " is out of range: the accessor has " +
                                                   std::to_string(accessor.count) + " elements");
    }
    std::memcpy(packed.data() + index * elementSize, values + i * elementSize, elementSize);
  }
  elements.packed = std::make_shared<const std::vector<uint8_t>>(std::move(packed));
  elements.first = elements.packed->data();
  elements.stride = elementSize;
}

// glTF 2.0 §3.6.2.2 for normalised integers; others stand for themselves.
template <typename T>
void convert(const Elements& elements, Picked picked, std::vector<float>& values) {
  constexpr bool kIsFloat = std::is_same_v<T, float>;
  const bool isNormalized = elements.isNormalized && !kIsFloat;
  const float divisor = isNormalized ? static_cast<float>(std::numeric_limits<T>::max()) : 1.0f;
  const float least = isNormalized ? -1.0f : -std::numeric_limits<float>::infinity();
  const size_t components = static_cast<size_t>(elements.components);
  for (size_t i = 0; i < values.size() / components; ++i) {
    const uint8_t* element = elements.first + (picked != nullptr ? (*picked)[i] : i) * elements.stride;
    for (size_t c = 0; c < components; ++c) {
      const float value = static_cast<float>(valueAt<T>(element, c)) / divisor;
      values[i * components + c] = value < least ? least : value;
    }
  }
}

// The bits of ComponentTypes that an accessor is of; 0 when no attribute may be of its type.
unsigned typesOf(const tinygltf::Accessor& accessor) {
  switch (accessor.componentType) {
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return kFloat;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return accessor.normalized ? unsigned{kNormalizedUnsigned} : kPlainInteger | kUnsigned;
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return accessor.normalized ? kNormalizedSigned : kPlainInteger;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return accessor.normalized ? 0 : unsigned{kUnsigned};
    default:
      return 0;
  }
}

// How many values are read, with their memory taken.
size_t takeValues(Document& document, const Elements& elements, const std::string& field, Picked picked) {
  const size_t count = picked != nullptr ? picked->size() : elements.count;
  document.takeMemory(count * static_cast<size_t>(elements.components) * 4,
                      elements.isStored ? count * elements.elementSize() : 0, field);
  return count * static_cast<size_t>(elements.components);
}

}  // namespace

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

int componentCount(const tinygltf::Accessor& accessor) {
  switch (accessor.type) {
    case TINYGLTF_TYPE_SCALAR:
      return 1;
    case TINYGLTF_TYPE_VEC2:
      return 2;
    case TINYGLTF_TYPE_VEC3:
      return 3;
    case TINYGLTF_TYPE_VEC4:
      return 4;
    case TINYGLTF_TYPE_MAT4:
      return 16;
    default:
      return 0;
  }
}

void requireType(const Document& document, const tinygltf::Accessor& accessor, int components, unsigned allowedTypes,
                 const std::string& field) {
  if (const int found = componentCount(accessor); found != components) {
    document.fail(field,
                  "its accessor has " + std::to_string(found) + " components instead of " + std::to_string(components));
  }
  if ((typesOf(accessor) & allowedTypes) == 0) {
    document.fail(field, "its accessor's component type " + std::to_string(accessor.componentType) +
                             (accessor.normalized ? " (normalized)" : "") + " is not allowed here");
  }
}

Elements elementsOf(Document& document, int index, int components, unsigned allowedTypes, const std::string& field) {
  const tinygltf::Accessor& accessor = document.model.accessors[static_cast<size_t>(index)];
  const std::string place = at("accessors", static_cast<size_t>(index));
  requireType(document, accessor, components, allowedTypes, field);
  Elements elements;
  elements.componentType = accessor.componentType;
  elements.components = components;
  elements.isNormalized = accessor.normalized;
  elements.count = accessor.count;
  if (accessor.bufferView >= 0) {
    const auto view = document.buffers.viewBytes(accessor.bufferView);
    const size_t stride = document.buffers.strideOf(accessor.bufferView);
    elements.stride = stride != 0 ? stride : elements.elementSize();
    requireInside(document, view, accessor.byteOffset, elements.stride, elements.elementSize(), accessor.count, place);
    elements.first = view.data() + accessor.byteOffset;
    elements.isStored = true;
  } else {
    elements.first = kZeros.data();
  }
  if (accessor.sparse.isSparse) applySparse(document, accessor, place, elements);
  return elements;
}

std::vector<float> toFloats(Document& document, const Elements& elements, const std::string& field, Picked picked) {
  std::vector<float> values(takeValues(document, elements, field, picked));
  switch (elements.componentType) {
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      convert<float>(elements, picked, values);
      break;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      convert<uint8_t>(elements, picked, values);
      break;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      convert<uint16_t>(elements, picked, values);
      break;
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      convert<int8_t>(elements, picked, values);
      break;
    default:
      convert<int16_t>(elements, picked, values);
      break;
  }
  const auto bad = std::find_if(values.begin(), values.end(), [](float v) { return !std::isfinite(v); });
  if (bad != values.end()) {
    const auto number = static_cast<size_t>(bad - values.begin()) / static_cast<size_t>(elements.components);
    const size_t element = picked != nullptr ? (*picked)[number] : number;
    document.fail(field, "element " + std::to_string(element) + " is not finite (NaN or infinite)");
  }
  return values;
}

std::vector<uint32_t> toUnsigned(Document& document, const Elements& elements, const std::string& field,
                                 Picked picked) {
  std::vector<uint32_t> values(takeValues(document, elements, field, picked));
  const size_t components = static_cast<size_t>(elements.components);
  for (size_t i = 0; i < values.size(); ++i) {
    const size_t number = i / components;
    const uint8_t* element = elements.first + (picked != nullptr ? (*picked)[number] : number) * elements.stride;
    values[i] = unsignedAt(element, i % components, elements.componentType);
  }
  return values;
}

std::vector<float> readFloats(Document& document, int accessor, int components, unsigned allowedTypes,
                              const std::string& field) {
  return toFloats(document, elementsOf(document, accessor, components, allowedTypes, field), field);
}

}  // namespace lensgraph::engine::gltf
