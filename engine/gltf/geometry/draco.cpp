// Reads the header of a Draco stream before libdraco allocates what it claims, decodes, and copies the vertices.
#include "engine/gltf/geometry/draco.h"

#include <draco/compression/decode.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <string_view>

#include "engine/error.h"

namespace lensgraph::engine::gltf {
namespace {

constexpr const char* kExtension = "KHR_draco_mesh_compression";

// A stream from its first byte on. Past the end everything is 0 and isAtEnd() true.
class StreamReader {
 public:
  explicit StreamReader(std::span<const uint8_t> bytes) : bytes_(bytes) {}

  bool isPastEnd() const { return isPastEnd_; }
  std::span<const uint8_t> rest() const { return bytes_; }

  uint8_t byte() {
    const auto one = take(1);
    return one.empty() ? uint8_t{0} : one[0];
  }

  std::span<const uint8_t> take(uint64_t count) {
    if (count > bytes_.size()) {
      isPastEnd_ = true;
      bytes_ = {};
      return {};
    }
    const auto taken = bytes_.first(count);
    bytes_ = bytes_.subspan(count);
    return taken;
  }

  // Seven bits a byte, the lowest first.
  uint64_t variableLength() {
    uint64_t value = 0;
    for (int shift = 0; shift < 35; shift += 7) {
      const uint8_t next = byte();
      value |= uint64_t{next & 0x7Fu} << shift;
      if ((next & 0x80) == 0) return value;
    }
    isPastEnd_ = true;
    return 0;
  }

 private:
  std::span<const uint8_t> bytes_;
  bool isPastEnd_ = false;
};

// Names and values that encoders note beside the geometry. libdraco would keep them; nothing here wants them.
void skipMetadata(StreamReader& reader) {
  const auto skipEntries = [&] {
    for (uint64_t left = reader.variableLength(); left > 0 && !reader.isPastEnd(); --left) {
      reader.take(reader.byte());
      reader.take(reader.variableLength());
    }
    return reader.variableLength();  // how many objects of the same kind are inside, each with a name
  };
  const auto skipObject = [&] {
    for (uint64_t inside = skipEntries(); inside > 0 && !reader.isPastEnd(); --inside) {
      reader.take(reader.byte());
      inside += skipEntries();
    }
  };
  for (uint64_t left = reader.variableLength(); left > 0 && !reader.isPastEnd(); --left) {
    reader.variableLength();  // the attribute's number
    skipObject();
  }
  skipObject();
}

class StreamDecoder {
 public:
  StreamDecoder(Document& document, const tinygltf::Primitive& primitive, const std::string& field)
      : document_(document),
        primitive_(primitive),
        field_(field + ".extensions." + kExtension),
        extension_(primitive.extensions.at(kExtension)) {}

  DracoMesh decode() {
    const int view = extension_.Get("bufferView").GetNumberAsInt();
    const auto stream = streamIn(view);
    const uint64_t promised = promisedBytes();
    document_.addDecoded(view, promised, field_);
    document_.takeMemory(promised, promised, field_);
    const std::vector<uint8_t> checked = checkedStream(stream);
    const std::unique_ptr<draco::Mesh> mesh = decodedMesh(checked);

    DracoMesh result;
    for (const std::string& name : extension_.Get("attributes").Keys()) {
      const auto accessor = primitive_.attributes.find(name);
      if (accessor == primitive_.attributes.end()) continue;
      const auto id = static_cast<uint32_t>(extension_.Get("attributes").Get(name).GetNumberAsInt());
      result.attributes[name] = attributeOf(*mesh, id, accessor->second, field_ + ".attributes." + name);
    }
    result.triangles.reserve(size_t{3} * mesh->num_faces());
    for (uint32_t f = 0; f < mesh->num_faces(); ++f) {
      for (const draco::PointIndex& point : mesh->face(draco::FaceIndex(f))) result.triangles.push_back(point.value());
    }
    return result;
  }

 private:
  [[noreturn]] void fail(const std::string& reason) const { document_.fail(field_, reason, "export the file again"); }

  // An error in the buffer also says that the extension needs it.
  std::span<const uint8_t> streamIn(int view) const {
    try {
      return document_.buffers.viewBytes(view);
    } catch (const Error& error) {
      document_.fail(field_, error.parts().field + ": " + error.parts().reason, error.parts().remedy);
    }
  }

  const tinygltf::Accessor& accessorAt(int index) const {
    return document_.model.accessors[static_cast<size_t>(index)];
  }

  uint64_t indexCount() const {
    if (primitive_.indices < 0) document_.fail(field_, "needs an accessor for the primitive's indices");
    return accessorAt(primitive_.indices).count;
  }

  uint64_t promisedBytes() const {
    uint64_t bytes = 4 * indexCount();
    for (const auto& [name, index] : primitive_.attributes) {
      const tinygltf::Accessor& accessor = accessorAt(index);
      if (extension_.Get("attributes").Has(name))
        bytes +=
            accessor.count * static_cast<uint64_t>(componentCount(accessor)) * componentSize(accessor.componentType);
    }
    return bytes;
  }

  // The stream without metadata; throws unless it is a mesh of as many triangles and vertices as the accessors promise.
  std::vector<uint8_t> checkedStream(std::span<const uint8_t> stream) const {
    constexpr uint8_t kMesh = 1, kSequential = 0, kEdgebreaker = 1, kHasMetadata = 0x80;
    StreamReader reader(stream);
    const auto header = reader.take(11);
    if (header.empty() || std::string_view(reinterpret_cast<const char*>(header.data()), 5) != "DRACO")
      fail("its stream is not Draco's");
    if (header[5] != 2 || header[6] != 2) {
      fail("its stream is of version " + std::to_string(header[5]) + "." + std::to_string(header[6]) +
           ", only 2.2 is allowed");
    }
    if (header[7] != kMesh || header[8] > kEdgebreaker) fail("its stream holds no mesh");
    const bool hasMetadata = (header[10] & kHasMetadata) != 0;
    if (hasMetadata) skipMetadata(reader);
    const auto body = reader.rest();
    std::vector<uint8_t> checked(header.size() + body.size());
    std::copy(body.begin(), body.end(), std::copy(header.begin(), header.end(), checked.begin()));
    if (hasMetadata) checked[10] &= static_cast<uint8_t>(~kHasMetadata);

    const bool isSequential = header[8] == kSequential;
    if (!isSequential) {
      reader.byte();            // how the surface is walked
      reader.variableLength();  // vertices before seams split them
    }
    const uint64_t triangles = reader.variableLength();
    const uint64_t vertices = isSequential ? reader.variableLength() : 0;
    if (reader.isPastEnd()) fail("its stream is damaged");
    if (triangles * 3 != indexCount()) {
      fail("its stream holds " + std::to_string(triangles) + " triangles, the primitive's accessor promises " +
           std::to_string(indexCount()) + " indices");
    }
    const auto position = primitive_.attributes.find("POSITION");
    if (isSequential && position != primitive_.attributes.end()) requireVertices(vertices, position->second);
    return checked;
  }

  void requireVertices(uint64_t found, int accessor) const {
    if (const uint64_t promised = accessorAt(accessor).count; found != promised) {
      fail("its stream holds " + std::to_string(found) + " vertices, accessors[" + std::to_string(accessor) +
           "] promises " + std::to_string(promised));
    }
  }

  std::unique_ptr<draco::Mesh> decodedMesh(std::span<const uint8_t> stream) const {
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(stream.data()), stream.size());
    auto result = draco::Decoder().DecodeMeshFromBuffer(&buffer);
    if (!result.ok()) fail("its stream is damaged");
    std::unique_ptr<draco::Mesh> mesh = std::move(result).value();
    if (uint64_t{mesh->num_faces()} * 3 != indexCount()) fail("its stream is damaged");
    return mesh;
  }

  Elements attributeOf(const draco::Mesh& mesh, uint32_t id, int accessorIndex, const std::string& field) const {
    const tinygltf::Accessor& accessor = accessorAt(accessorIndex);
    const draco::PointAttribute* attribute = mesh.GetAttributeByUniqueId(id);
    if (attribute == nullptr) document_.fail(field, "the stream has no attribute " + std::to_string(id));
    Elements elements;
    elements.componentType = accessor.componentType;
    elements.components = componentCount(accessor);
    elements.isNormalized = accessor.normalized;
    elements.count = accessor.count;
    if (attribute->num_components() != elements.components) {
      document_.fail(field, "the stream has " + std::to_string(attribute->num_components()) +
                                " components, its accessor " + std::to_string(elements.components));
    }
    requireVertices(mesh.num_points(), accessorIndex);
    elements.stride = elements.elementSize();
    std::vector<uint8_t> packed(elements.count * elements.stride);
    if (!copyValues(*attribute, elements, packed.data()))
      document_.fail(field, "the stream's values do not fit into its accessor");
    elements.packed = std::make_shared<const std::vector<uint8_t>>(std::move(packed));
    elements.first = elements.packed->data();
    return elements;
  }

  static bool copyValues(const draco::PointAttribute& attribute, const Elements& elements, uint8_t* target) {
    switch (elements.componentType) {
      case TINYGLTF_COMPONENT_TYPE_BYTE:
        return copyAs<int8_t>(attribute, elements, target);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return copyAs<uint8_t>(attribute, elements, target);
      case TINYGLTF_COMPONENT_TYPE_SHORT:
        return copyAs<int16_t>(attribute, elements, target);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return copyAs<uint16_t>(attribute, elements, target);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return copyAs<uint32_t>(attribute, elements, target);
      case TINYGLTF_COMPONENT_TYPE_FLOAT:
        return copyAs<float>(attribute, elements, target);
      default:
        return false;
    }
  }

  template <typename T>
  static bool copyAs(const draco::PointAttribute& attribute, const Elements& elements, uint8_t* target) {
    std::vector<T> value(static_cast<size_t>(elements.components));
    for (size_t i = 0; i < elements.count; ++i) {
      const draco::AttributeValueIndex index = attribute.mapped_index(draco::PointIndex(static_cast<uint32_t>(i)));
      if (index.value() >= attribute.size()) return false;
      if (!attribute.ConvertValue<T>(index, static_cast<int8_t>(elements.components), value.data())) return false;
      std::memcpy(target + i * elements.stride, value.data(), elements.stride);
    }
    return true;
  }

  Document& document_;
  const tinygltf::Primitive& primitive_;
  std::string field_;
  const tinygltf::Value& extension_;
};

}  // namespace

bool isDraco(const tinygltf::Primitive& primitive) {
  return primitive.extensions.contains(kExtension);
}

DracoMesh decodeDraco(Document& document, const tinygltf::Primitive& primitive, const std::string& field) {
  return StreamDecoder(document, primitive, field).decode();
}

}  // namespace lensgraph::engine::gltf
