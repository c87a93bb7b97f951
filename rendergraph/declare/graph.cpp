// Declaring resources and passes. Checks what one call can be wrong about; what concerns the whole declaration
// (content never written, device limits, cycles) is checked by compile().
#include "rendergraph/graph.h"

#include <algorithm>
#include <string>

#include "rendergraph/declaration_observer.h"
#include "rendergraph/declare/declaration.h"

namespace lensgraph::rendergraph {

namespace {

Image imageHandle(const Declaration& declaration, uint32_t index) {
  return {.resource = index, .version = declaration.resources[index].version, .graph = declaration.serial};
}

Buffer bufferHandle(const Declaration& declaration, uint32_t index) {
  return {.resource = index, .version = declaration.resources[index].version, .graph = declaration.serial};
}

void reportImageShape(Declaration& declaration, uint32_t index) {
  const DeclaredResource& resource = declaration.resources[index];
  const auto report = [&](Misuse misuse, std::string reason, std::string remedy) {
    declaration.report(misuse, kNone, index, std::move(reason), std::move(remedy), resource.where);
  };
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

bool shapeIsRight(const ImageDesc& desc) {
  return desc.format != VK_FORMAT_UNDEFINED && desc.width != 0 && desc.height != 0 && desc.layers != 0 &&
         (desc.mips == 1 || (desc.mips != 0 && desc.mips <= fullMipCount(desc.width, desc.height)));
}

uint32_t addImage(Declaration& declaration, std::string_view name, const ImageDesc& desc, Origin origin,
                  std::source_location where) {
  const uint32_t index = declaration.resources.size();
  DeclaredResource& resource = declaration.resources.add();
  resource.name = declaration.arena.copy(name);
  resource.where = where;
  resource.origin = origin;
  resource.image = desc;
  resource.aspects = aspectsOf(desc.format);
  if (shapeIsRight(desc)) [[likely]] {
    resource.ordinary = origin == Origin::created && resource.aspects == VK_IMAGE_ASPECT_COLOR_BIT;
  } else {
    reportImageShape(declaration, index);
  }
  return index;
}

uint32_t addBuffer(Declaration& declaration, std::string_view name, const BufferDesc& desc, Origin origin,
                   std::source_location where) {
  const uint32_t index = declaration.resources.size();
  DeclaredResource& resource = declaration.resources.add();
  resource.name = declaration.arena.copy(name);
  resource.where = where;
  resource.isImage = false;
  resource.origin = origin;
  resource.buffer = desc;
  resource.ordinary = origin == Origin::created;
  if (desc.size == 0) {
    declaration.report(Misuse::overLimit, kNone, index, "its size is zero", "give it at least one byte", where);
  }
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
    if (other.persistent() && other.key == added.key && !halvesOfOneHistory) {
      declaration.report(Misuse::doubleWrite, kNone, index, "two persistent resources of the graph have this name",
                         "declare it once and pass the handle on, or give them different names", added.where);
      return;
    }
  }
}

/// Gives a persistent resource the key under which the executor keeps it: its name without a suffix.
uint32_t withKey(Declaration& declaration, uint32_t index, std::size_t keyLength) {
  declaration.resources[index].key = declaration.resources[index].name.substr(0, keyLength);
  checkKeyIsUnique(declaration, index);
  return index;
}

uint32_t addHistorySide(Declaration& declaration, std::string_view name, std::string_view suffix, const ImageDesc& desc,
                        Origin origin, std::source_location where) {
  // The two names are put together in the arena, so that re-declaring a frame asks the heap for nothing.
  char* text = static_cast<char*>(declaration.arena.allocate(name.size() + suffix.size(), 1));
  name.copy(text, name.size());
  suffix.copy(text + name.size(), suffix.size());
  const uint32_t index = addImage(declaration, {text, name.size() + suffix.size()}, desc, origin, where);
  return withKey(declaration, index, name.size());
}

void checkStates(Declaration& declaration, uint32_t index, std::source_location where) {
  DeclaredResource& resource = declaration.resources[index];
  resource.stated = true;
  checkState(declaration, index, resource.before, "before", where);
  checkState(declaration, index, resource.after, "after", where);
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
  resource.stated = true;
  resource.after = after;
}

}  // namespace

Graph::Graph() : declaration_(std::make_unique<Declaration>()) {}
Graph::~Graph() = default;
Graph::Graph(Graph&&) noexcept = default;
Graph& Graph::operator=(Graph&&) noexcept = default;

void Graph::reset() {
  declaration_->reset();
  if (observer_ != nullptr) observer_->declarationReset();
}

Image Graph::createImage(std::string_view name, const ImageDesc& desc, Location where) {
  return imageHandle(*declaration_, addImage(*declaration_, name, desc, Origin::created, where));
}

Buffer Graph::createBuffer(std::string_view name, const BufferDesc& desc, Location where) {
  return bufferHandle(*declaration_, addBuffer(*declaration_, name, desc, Origin::created, where));
}

Image Graph::importImage(std::string_view name, const ImageDesc& desc, const ImportedImage& imported, Location where) {
  const uint32_t index = addImage(*declaration_, name, desc, Origin::imported, where);
  DeclaredResource& resource = declaration_->resources[index];
  resource.importedImage = imported.image;
  resource.importedImageUsage = imported.usage;
  resource.before = imported.before;
  resource.after = imported.after;
  checkStates(*declaration_, index, where);
  if (imported.after.layout == VK_IMAGE_LAYOUT_PREINITIALIZED) {
    declaration_->report(Misuse::importState, kNone, index, "no image can be left in layout PREINITIALIZED",
                         "name the layout in which the host will use it", where);
  }
  return imageHandle(*declaration_, index);
}

Buffer Graph::importBuffer(std::string_view name, const BufferDesc& desc, const ImportedBuffer& imported,
                           Location where) {
  const uint32_t index = addBuffer(*declaration_, name, desc, Origin::imported, where);
  DeclaredResource& resource = declaration_->resources[index];
  resource.importedBuffer = imported.buffer;
  resource.importedBufferUsage = imported.usage;
  resource.before = imported.before;
  resource.after = imported.after;
  checkStates(*declaration_, index, where);
  return bufferHandle(*declaration_, index);
}

Image Graph::persistentImage(std::string_view name, const ImageDesc& desc, Location where) {
  const uint32_t index = addImage(*declaration_, name, desc, Origin::persistent, where);
  return imageHandle(*declaration_, withKey(*declaration_, index, name.size()));
}

Buffer Graph::persistentBuffer(std::string_view name, const BufferDesc& desc, Location where) {
  const uint32_t index = addBuffer(*declaration_, name, desc, Origin::persistent, where);
  return bufferHandle(*declaration_, withKey(*declaration_, index, name.size()));
}

History Graph::history(std::string_view name, const ImageDesc& desc, Location where) {
  Declaration& declaration = *declaration_;
  const uint32_t previous = addHistorySide(declaration, name, " (previous)", desc, Origin::historyPrevious, where);
  const uint32_t next = addHistorySide(declaration, name, " (next)", desc, Origin::historyNext, where);
  return {imageHandle(declaration, previous), imageHandle(declaration, next)};
}

void Graph::exportImage(Image image, const AccessState& after, Location where) {
  exportResource(*declaration_, image, after, where);
  if (observer_ != nullptr) observer_->passesDeclared(*this, false);
}

void Graph::exportBuffer(Buffer buffer, const AccessState& after, Location where) {
  exportResource(*declaration_, buffer, after, where);
  if (observer_ != nullptr) observer_->passesDeclared(*this, false);
}

void Graph::finish() {
  if (observer_ != nullptr) observer_->passesDeclared(*this, true);
}

Pass Graph::addPass(std::string_view name, PassKind kind, Location where) {
  finish();
  DeclaredPass& pass = declaration_->passes.add();
  pass.name = declaration_->arena.copy(name);
  pass.kind = kind;
  pass.where = where;
  return Pass(*declaration_, declaration_->passes.size() - 1);
}

const ImageDesc& Graph::desc(Image image) const {
  return declaration_->resources[declaration_->indexOf(image, kNone, Location::current())].image;
}

const BufferDesc& Graph::desc(Buffer buffer) const {
  return declaration_->resources[declaration_->indexOf(buffer, kNone, Location::current())].buffer;
}

}  // namespace lensgraph::rendergraph
