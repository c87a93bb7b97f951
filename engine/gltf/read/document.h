// A glTF file, parsed and checked: what its other parts are read from. Private to engine/gltf.
#pragma once

#include <cstdint>
#include <filesystem>
#include <set>
#include <string>

#include "engine/gltf/read/buffers.h"
#include "engine/gltf/read/memory_limit.h"
#include "engine/gltf/read/source.h"
#include "engine/gltf/read/tiny_gltf.h"
#include "engine/gltf/read/warnings.h"

namespace lensgraph::engine::gltf {

/// Every index in the model has been checked against the array that it points into, every member's type and length
/// against the specification; byte ranges have not: they are checked where bytes are read.
struct Document : Source {
  /// Without buffers and buffer views; images hold uri or bufferView, not pixels; animations, "extras" and extensions
  /// that nothing reads are left out.
  tinygltf::Model model;
  Buffers buffers;
  Warnings warnings;

  void warn(const std::string& text, const std::string& place = {}) { warnings.add(text, place); }

  /// What is loaded from here on stands for itself: see MemoryLimit::startPart().
  void startPart() { memory_.startPart(); }
  /// Takes memory for `loaded` bytes of scene, read from `stored` bytes of the file. To be called before they are
  /// allocated. Throws Error naming the field when the file asks for more than memory_limit.h allows.
  void takeMemory(uint64_t loaded, uint64_t stored, const std::string& field);
  /// Takes memory for placements of primitives beyond the first of each node. All of them may come to kInstanceBytes for
  /// each byte of the file's buffers, and kInstanceBase more. Throws Error naming the field.
  void takeInstances(uint64_t bytes, const std::string& field);
  static constexpr uint64_t kInstanceBase = 32'000'000, kInstanceBytes = 16;
  /// What the Draco stream in a buffer view decodes to counts as bytes of the file, once for each view. All of them may
  /// come to kDecodedBytes for each byte of the file, and kDecodedBase more (flat grids shrink without end). To be called
  /// before decoding. Throws Error naming the field.
  void addDecoded(int bufferView, uint64_t bytes, const std::string& field);
  static constexpr uint64_t kDecodedBase = 8'000'000, kDecodedBytes = 256;

 private:
  friend Document readDocument(const std::filesystem::path& path);
  Document(Source source, tinygltf::Model parsed, Buffers taken)
      : Source(std::move(source)), model(std::move(parsed)), buffers(std::move(taken)) {}

  uint64_t bytesHeld() const { return buffers.bytesRead() + buffers.bytesDecoded() + bytesDecoded_; }

  MemoryLimit memory_;
  std::set<int> decodedViews_;
  uint64_t bytesDecoded_ = 0, instanceBytes_ = 0;
};

/// Reads and checks a .gltf or .glb file, told apart by content. Opens none of the files that it names.
Document readDocument(const std::filesystem::path& path);

/// A JSON number (double) as float; throws Error naming the field where it would become infinite.
float toFloat(const Source& source, double value, const std::string& field);

}  // namespace lensgraph::engine::gltf
