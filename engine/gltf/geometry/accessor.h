// Accessors to plain arrays. Every byte range is checked here, once, before it is read. Private to engine/gltf.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/gltf/read/document.h"

namespace lensgraph::engine::gltf {

/// Component types of an accessor that an attribute allows, as bits.
enum ComponentTypes : unsigned {
  kFloat = 1,
  kNormalizedUnsigned = 2,  ///< u8 and u16 that stand for 0…1
  kNormalizedSigned = 4,    ///< s8 and s16 that stand for −1…1
  kPlainInteger = 8,        ///< 8 and 16 bit integers that stand for themselves (KHR_mesh_quantization)
  kUnsigned = 16,           ///< u8, u16 and u32 that stand for themselves, as indices do
};

/// Bytes of one component; 0 for what is no component type of glTF.
size_t componentSize(int componentType);

/// Components of a scalar, vector or MAT4 accessor; 0 for other types.
int componentCount(const tinygltf::Accessor& accessor);

/// An accessor's elements where they lie, or, where they are put together first (sparse, compressed), packed.
struct Elements {
  int componentType = 0;
  int components = 0;
  bool isNormalized = false;
  size_t count = 0;
  const uint8_t* first = nullptr;
  size_t stride = 0;                                     ///< 0 where all elements are the same (zeros).
  bool isStored = false;                                 ///< The file holds each of them.
  std::shared_ptr<const std::vector<uint8_t>> packed{};  ///< May own what `first` points to.

  size_t elementSize() const { return componentSize(componentType) * static_cast<size_t>(components); }
};

/// The numbers of the elements to read; null: all.
using Picked = const std::vector<uint32_t>*;

/// Throws Error naming `field` when an accessor is of another type than is allowed there.
void requireType(const Document& document, const tinygltf::Accessor& accessor, int components, unsigned allowedTypes,
                 const std::string& field);

/// Throws Error: a type that is not allowed, a range outside the buffer.
Elements elementsOf(Document& document, int accessor, int components, unsigned allowedTypes, const std::string& field);

/// Elements as floats, tightly packed. Each number in `picked` must be below the count. Throws Error naming `field`: a
/// non-finite value, more memory than is allowed.
std::vector<float> toFloats(Document& document, const Elements& elements, const std::string& field,
                            Picked picked = nullptr);

/// Elements of plain unsigned integers.
std::vector<uint32_t> toUnsigned(Document& document, const Elements& elements, const std::string& field,
                                 Picked picked = nullptr);

/// elementsOf() and toFloats() in one.
std::vector<float> readFloats(Document& document, int accessor, int components, unsigned allowedTypes,
                              const std::string& field);

}  // namespace lensgraph::engine::gltf
