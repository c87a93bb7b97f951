// The plain data behind a Graph: what was declared, in the order of the calls, with every default resolved.
// compile() reads it, nothing changes it but Graph and Pass. Records and arena keep their memory over reset().
#pragma once

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <iterator>
#include <source_location>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

#include "rendergraph/declare/arena.h"
#include "rendergraph/declare/records.h"
#include "rendergraph/error.h"
#include "rendergraph/handle.h"
#include "rendergraph/pass_kind.h"
#include "rendergraph/program.h"
#include "rendergraph/resource.h"
#include "rendergraph/usage.h"

namespace lensgraph::rendergraph {

class PassContext;

/// Who owns a resource and how long it lives.
enum class Origin : uint8_t {
  created,          ///< Of the graph, within the frame.
  imported,         ///< Of the host.
  persistent,       ///< Of the executor, across frames.
  historyPrevious,  ///< Of the executor; changes places with historyNext after a frame that wrote that.
  historyNext,
};

// What compile() reads of a resource, access or pass stands in a *Structure without padding, which structuralHash()
// takes byte by byte: a field added there cannot be forgotten in the key of the plan cache.

struct ResourceStructure {
  bool isImage = true;
  Origin origin = Origin::created;
  bool exported = false;
  bool stated = false;  ///< `before` or `after` of the resource say something; they belong to the structure then.
  VkImageAspectFlags aspects = 0;
  ImageDesc image;
  VkImageUsageFlags importedImageUsage = 0;
  BufferDesc buffer;
  VkBufferUsageFlags importedBufferUsage = 0;
  uint32_t version = 0;  ///< Writes so far.
};
static_assert(std::has_unique_object_representations_v<ResourceStructure>);

struct DeclaredResource : ResourceStructure {
  uint32_t lastAccess = kNone;  ///< Linked through DeclaredAccess::previousOfResource.
  uint32_t lastPass = kNone;    ///< Of that access.
  bool ordinary = false;        ///< Of the graph, of right shape, a buffer or a colour image.
  std::string_view name;        ///< For people.
  std::source_location where;
  // Nothing below is used by a plain resource of the graph.
  std::string_view key;  ///< Persistent and history: the name under which the executor keeps it.
  VkImage importedImage = VK_NULL_HANDLE;
  VkBuffer importedBuffer = VK_NULL_HANDLE;
  AccessState before;  ///< Imported only.
  AccessState after;   ///< Imported or exported.

  DeclaredResource() {}  // Written out: a default constructor of the compiler's clears all bytes first.

  bool created() const { return origin == Origin::created; }
  bool imported() const { return origin == Origin::imported; }
  /// Kept by the executor.
  bool persistent() const { return !created() && !imported(); }
  /// Whether its final content is seen by somebody outside the graph.
  bool observable() const { return exported || !created(); }
};

/// `resolve`: receives the mean of the samples of the colour attachment declared before it.
enum class AttachmentRole : uint8_t { none, color, depth, resolve };

struct AccessStructure {
  uint32_t pass = kNone;
  uint32_t resource = kNone;
  Usage usage = Usage::sampled;
  AccessMode mode = AccessMode::read;
  AttachmentRole role = AttachmentRole::none;
  LoadOp load = LoadOp::dontCare;
  Subresources range;                ///< Resolved; {0, 1, 0, 1, 0} for buffers.
  VkPipelineStageFlags2 stages = 0;  ///< With the shader stages that the call left out.
};
static_assert(std::has_unique_object_representations_v<AccessStructure>);

struct DeclaredAccess : AccessStructure {
  uint32_t nextOfPass = kNone;                       ///< Next access of the same pass, in order of calls.
  uint32_t previousOfResource = kNone;               ///< The access of the same resource before, in order of calls.
  uint32_t version = 0;                              ///< Of the handle that was given.
  VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;  ///< Agreed among overlapping accesses of the pass.
  VkAccessFlags2 access = 0;
  VkClearValue clear = {};
  std::source_location where;

  DeclaredAccess() {}  // As above.

  bool writes() const { return mode != AccessMode::read; }
  bool needsContent() const { return mode != AccessMode::write; }
};

/// A binding of a ComputePass: one of the pass's accesses, and what shows it to the shader.
struct DispatchBinding {
  uint32_t access;  ///< Among Declaration::accesses.
  VkImageViewType viewType = VK_IMAGE_VIEW_TYPE_2D;
  SamplerDesc sampler;
};

/// The one dispatch of a ComputePass. All of it lies in the arena, and needs no destruction.
struct DeclaredDispatch {
  const ComputeProgram* program;
  std::span<const DispatchBinding> bindings;
  std::span<const std::byte> pushConstants;
  std::span<const uint32_t> specialization;
  Groups groups;
  uint32_t indirect = kNone;  ///< The buffer's resource; kNone: `groups` counts.
  VkDeviceSize indirectOffset = 0;
};

struct PassStructure {
  PassKind kind = PassKind::compute;
  QueuePreference queue = QueuePreference::graphics;
  bool sideEffect = false;
  bool disabled = false;           ///< Pass::onlyIf(false); it has no accesses.
  VkExtent2D renderArea = {0, 0};  ///< Raster: of the attachments, or as declared.
  uint32_t renderLayers = 1;
};
static_assert(std::has_unique_object_representations_v<PassStructure>);

struct DeclaredPass : PassStructure {
  using Recorder = void (*)(void* recording, PassContext& context);
  using Destroyer = void (*)(void* recording);

  bool hasAttachments = false;
  uint32_t firstAccess = kNone, lastAccess = kNone;  ///< Linked through DeclaredAccess::nextOfPass.
  std::string_view name;
  std::source_location where;
  void* recording = nullptr;
  Recorder recorder = nullptr;
  Destroyer destroyer = nullptr;  ///< None for a recording that needs no destruction.
  /// Of a ComputePass, which has no recording.
  const DeclaredDispatch* dispatch = nullptr;
  bool unfinished = false;  ///< A ComputePass whose chain of calls has no end so far.

  DeclaredPass() {}  // As above.
};

/// The accesses of one pass or of one resource, for range-for.
template <uint32_t DeclaredAccess::*Next>
class AccessList {
 public:
  struct Iterator {
    const Records<DeclaredAccess>* accesses;
    uint32_t index;
    const DeclaredAccess& operator*() const { return (*accesses)[index]; }
    Iterator& operator++() {
      index = (*accesses)[index].*Next;
      return *this;
    }
    bool operator!=(const Iterator& other) const { return index != other.index; }
  };
  AccessList(const Records<DeclaredAccess>& accesses, uint32_t first) : accesses_(&accesses), first_(first) {}
  Iterator begin() const { return {accesses_, first_}; }
  Iterator end() const { return {accesses_, kNone}; }

 private:
  const Records<DeclaredAccess>* accesses_;
  uint32_t first_;
};

struct Declaration {
  uint32_t serial = 0;  ///< Stamped on handles, so that those of another declaration are recognised.
  Records<DeclaredResource> resources;
  Records<DeclaredPass> passes;
  Records<DeclaredAccess> accesses;  ///< In order of calls.
  std::vector<GraphError::Problem> problems;
  Arena arena;
  /// Whether every access was declared before those of later passes, so that the order of the passes is one in which
  /// they can run. Accesses of different passes may be declared interleaved; then compile() looks for an order.
  bool inOrder = true;
  uint32_t latestPass = 0;           ///< Of the latest access.
  bool recordingsToDestroy = false;  ///< Some recording has a destructor.
  uint32_t unfinishedPasses = 0;     ///< How many passes are DeclaredPass::unfinished.

  Declaration();
  ~Declaration();
  Declaration(const Declaration&) = delete;
  Declaration& operator=(const Declaration&) = delete;

  /// Destroys the recordings, forgets everything, keeps the memory, and takes a new serial number.
  void reset();

  /// Index of an access among `accesses`. Precondition: the reference is to one of them.
  uint32_t numberOf(const DeclaredAccess& access) const { return static_cast<uint32_t>(&access - accesses.begin()); }
  AccessList<&DeclaredAccess::nextOfPass> accessesOfPass(uint32_t pass) const {
    return {accesses, passes[pass].firstAccess};
  }
  /// The latest first.
  AccessList<&DeclaredAccess::previousOfResource> accessesOfResource(uint32_t resource) const {
    return {accesses, resources[resource].lastAccess};
  }

  /// Notes a misuse to be thrown by compile(). kNone for a pass or resource that is not concerned.
  void report(Misuse misuse, uint32_t pass, uint32_t resource, std::string reason, std::string remedy,
              std::source_location where);
  /// What was reported, and the passes that are unfinished now. Empty when the declaration can be compiled.
  std::vector<GraphError::Problem> allProblems() const;
  /// What report() notes, as data.
  GraphError::Problem problem(Misuse misuse, uint32_t pass, uint32_t resource, std::string reason, std::string remedy,
                              std::source_location where) const;

  /// Index of the resource that a handle names. Throws GraphError (unknownHandle, foreignHandle) when it names
  /// none of this declaration; nothing sensible could follow such a handle.
  template <class Tag>
  uint32_t indexOf(const Handle<Tag>& handle, uint32_t pass, std::source_location where) const {
    if (handle.graph != serial || handle.resource >= resources.size()) [[unlikely]] {
      throwHandle(handle.resource, handle.graph, pass, where);
    }
    return handle.resource;
  }

 private:
  [[noreturn]] void throwHandle(uint32_t resource, uint32_t graph, uint32_t pass, std::source_location where) const;
  void destroyRecordings();
};

/// State in which a persistent resource rests between frames: every later use is ordered after the last one, and
/// everything is visible to it. An exported one rests in the layout that the host asked for, the others in GENERAL,
/// which every use of an image allows.
inline AccessState restStateOf(const DeclaredResource& resource) {
  return {.stages = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
          .access = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT,
          .layout = resource.exported ? resource.after.layout : VK_IMAGE_LAYOUT_GENERAL};
}

}  // namespace lensgraph::rendergraph
