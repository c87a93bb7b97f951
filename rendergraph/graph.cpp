// Declaring resources and passes. Checks what one call can be wrong about; what concerns the whole declaration
// (content never written, device limits, cycles) is checked by compile().
#include "rendergraph/graph.h"

#include <algorithm>
#include <string>

#include "rendergraph/declaration.h"
#include "rendergraph/image_tap.h"

namespace rendergraph {

namespace {

Image imageHandle(const Declaration& declaration, uint32_t index) {
  return {.resource = index, .version = declaration.resources[index].version, .graph = declaration.serial};
}

Buffer bufferHandle(const Declaration& declaration, uint32_t index) {
  return {.resource = index, .version = declaration.resources[index].version, .graph = declaration.serial};
}

void checkShape(Declaration& declaration, uint32_t index) {
  const DeclaredResource& resource = declaration.resources[index];
  const auto report = [&](Misuse misuse, std::string reason, std::string remedy) {
    declaration.report(misuse, kNone, index, std::move(reason), std::move(remedy), resource.where);
  };
  if (!resource.isImage) {
    if (resource.buffer.size == 0) report(Misuse::overLimit, "its size is zero", "give it at least one byte");
    return;
  }
  const ImageDesc& desc = resource.image;
  if (desc.format == VK_FORMAT_UNDEFINED) {
    report(Misuse::formatMismatch, "its format is UNDEFINED", "name a format");
  }
  if (desc.width == 0 || desc.height == 0 || desc.layers == 0 || desc.mips == 0) {
    report(Misuse::overLimit,
           "its size is " + std::to_string(desc.width) + "x" + std::to_string(desc.height) + ", " +
               std::to_string(desc.layers) + " layers, " + std::to_string(desc.mips) + " mips",
           "make every one of them at least 1");
    return;
  }
  const uint32_t fullChain = fullMipCount(desc.width, desc.height);
  if (desc.mips > fullChain) {
    report(Misuse::overLimit,
           std::to_string(desc.mips) + " mips of a " + std::to_string(desc.width) + "x" + std::to_string(desc.height) +
               " image",
           "declare at most " + std::to_string(fullChain));
  }
}

uint32_t addResource(Declaration& declaration, DeclaredResource resource, std::string_view name) {
  resource.name = declaration.arena.copy(name);
  if (resource.isImage) resource.aspects = aspectsOf(resource.image.format);
  declaration.resources.push_back(resource);
  const auto index = static_cast<uint32_t>(declaration.resources.size() - 1);
  checkShape(declaration, index);
  return index;
}

/// `after`: state NONE/UNDEFINED asks for nothing.
void checkState(Declaration& declaration, uint32_t index, const AccessState& state, const char* which,
                std::source_location where) {
  if (state.access != 0 && state.stages == 0) {
    declaration.report(Misuse::importState, kNone, index,
                       std::string("its state ") + which + " the graph has accesses but no stages",
                       "name the pipeline stages that make the accesses", where);
  }
}

void checkKeyIsUnique(Declaration& declaration, uint32_t index) {
  const DeclaredResource& added = declaration.resources[index];
  for (uint32_t i = 0; i < index; ++i) {
    const DeclaredResource& other = declaration.resources[i];
    const bool halvesOfOneHistory =
        other.origin == Origin::historyPrevious && added.origin == Origin::historyNext && i + 1 == index;
    if (other.retained() && other.key == added.key && !halvesOfOneHistory) {
      declaration.report(Misuse::doubleWrite, kNone, index, "two persistent resources of the graph have this name",
                         "declare it once and pass the handle on, or give them different names", added.where);
      return;
    }
  }
}

uint32_t addRetained(Declaration& declaration, std::string_view key, std::string_view suffix,
                     DeclaredResource resource) {
  const uint32_t index = addResource(declaration, resource, std::string(key).append(suffix));
  declaration.resources[index].key = declaration.resources[index].name.substr(0, key.size());
  checkKeyIsUnique(declaration, index);
  return index;
}

template <class Tag>
void exportResource(Declaration& declaration, const Handle<Tag>& handle, const AccessState& after,
                    std::source_location where) {
  const uint32_t index = declaration.indexOf(handle, kNone, where);
  DeclaredResource& resource = declaration.resources[index];
  if (handle.version != resource.version) {
    declaration.report(Misuse::staleVersion, kNone, index,
                       "version " + std::to_string(handle.version) + " is exported, but version " +
                           std::to_string(resource.version) + " is the latest",
                       "export the handle that the last write returned", where);
  }
  if (resource.isImage && after.layout == VK_IMAGE_LAYOUT_UNDEFINED) {
    declaration.report(Misuse::importState, kNone, index, "it is exported without a layout",
                       "name the layout in which the host will use it", where);
  }
  checkState(declaration, index, after, "after", where);
  resource.exported = true;
  resource.after = after;
}

}  // namespace

Graph::Graph() : declaration_(std::make_unique<Declaration>()) {}
Graph::~Graph() = default;
Graph::Graph(Graph&&) noexcept = default;
Graph& Graph::operator=(Graph&&) noexcept = default;

void Graph::reset() {
  declaration_->reset();
  if (taps_ != nullptr) taps_->restart();
}

Image Graph::createImage(std::string_view name, const ImageDesc& desc, Location where) {
  DeclaredResource resource;
  resource.image = desc;
  resource.where = where;
  return imageHandle(*declaration_, addResource(*declaration_, resource, name));
}

Buffer Graph::createBuffer(std::string_view name, const BufferDesc& desc, Location where) {
  DeclaredResource resource;
  resource.isImage = false;
  resource.buffer = desc;
  resource.where = where;
  return bufferHandle(*declaration_, addResource(*declaration_, resource, name));
}

Image Graph::importImage(std::string_view name, const ImageDesc& desc, const ImportedImage& imported, Location where) {
  DeclaredResource resource;
  resource.origin = Origin::imported;
  resource.image = desc;
  resource.importedImage = imported.image;
  resource.importedImageUsage = imported.usage;
  resource.before = imported.before;
  resource.after = imported.after;
  resource.where = where;
  const uint32_t index = addResource(*declaration_, resource, name);
  checkState(*declaration_, index, imported.before, "before", where);
  checkState(*declaration_, index, imported.after, "after", where);
  if (imported.after.layout == VK_IMAGE_LAYOUT_PREINITIALIZED) {
    declaration_->report(Misuse::importState, kNone, index, "no image can be left in layout PREINITIALIZED",
                         "name the layout in which the host will use it", where);
  }
  return imageHandle(*declaration_, index);
}

Buffer Graph::importBuffer(std::string_view name, const BufferDesc& desc, const ImportedBuffer& imported,
                           Location where) {
  DeclaredResource resource;
  resource.isImage = false;
  resource.origin = Origin::imported;
  resource.buffer = desc;
  resource.importedBuffer = imported.buffer;
  resource.importedBufferUsage = imported.usage;
  resource.before = imported.before;
  resource.after = imported.after;
  resource.where = where;
  const uint32_t index = addResource(*declaration_, resource, name);
  checkState(*declaration_, index, imported.before, "before", where);
  checkState(*declaration_, index, imported.after, "after", where);
  return bufferHandle(*declaration_, index);
}

Image Graph::persistentImage(std::string_view name, const ImageDesc& desc, Location where) {
  DeclaredResource resource;
  resource.origin = Origin::persistent;
  resource.image = desc;
  resource.where = where;
  return imageHandle(*declaration_, addRetained(*declaration_, name, "", resource));
}

Buffer Graph::persistentBuffer(std::string_view name, const BufferDesc& desc, Location where) {
  DeclaredResource resource;
  resource.isImage = false;
  resource.origin = Origin::persistent;
  resource.buffer = desc;
  resource.where = where;
  return bufferHandle(*declaration_, addRetained(*declaration_, name, "", resource));
}

History Graph::history(std::string_view name, const ImageDesc& desc, Location where) {
  DeclaredResource resource;
  resource.image = desc;
  resource.where = where;
  resource.origin = Origin::historyPrevious;
  const uint32_t previous = addRetained(*declaration_, name, " (previous)", resource);
  resource.origin = Origin::historyNext;
  const uint32_t next = addRetained(*declaration_, name, " (next)", resource);
  return {imageHandle(*declaration_, previous), imageHandle(*declaration_, next)};
}

void Graph::exportImage(Image image, const AccessState& after, Location where) {
  exportResource(*declaration_, image, after, where);
  if (taps_ != nullptr) taps_->follow(*this, false);
}

void Graph::exportBuffer(Buffer buffer, const AccessState& after, Location where) {
  exportResource(*declaration_, buffer, after, where);
  if (taps_ != nullptr) taps_->follow(*this, false);
}

void Graph::finishTaps() {
  if (taps_ != nullptr) taps_->follow(*this, true);
}

Pass Graph::addPass(std::string_view name, PassKind kind, Location where) {
  finishTaps();
  DeclaredPass pass;
  pass.name = declaration_->arena.copy(name);
  pass.kind = kind;
  pass.where = where;
  declaration_->passes.push_back(pass);
  return Pass(*this, static_cast<uint32_t>(declaration_->passes.size() - 1));
}

const ImageDesc& Graph::desc(Image image) const {
  return declaration_->resources[declaration_->indexOf(image, kNone, Location::current())].image;
}

const BufferDesc& Graph::desc(Buffer buffer) const {
  return declaration_->resources[declaration_->indexOf(buffer, kNone, Location::current())].buffer;
}

void* Graph::allocateRecording(std::size_t size, std::size_t alignment) {
  return declaration_->arena.allocate(size, alignment);
}

void Graph::setRecording(uint32_t pass, void* recording, Recorder recorder, Destroyer destroyer) {
  DeclaredPass& declared = declaration_->passes[pass];
  if (declared.destroyer != nullptr) declared.destroyer(declared.recording);  // record() was called again.
  declared.recording = recording;
  declared.recorder = recorder;
  declared.destroyer = destroyer;
}

}  // namespace rendergraph
