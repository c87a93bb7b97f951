// A backend without a device: writes down what it is asked for, counts living objects, simulates the order in which
// submissions finish, notes what no backend should be asked for, and fails on demand.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "rendergraph/backend.h"
#include "rendergraph/error.h"

namespace lensgraph {

class FakeBackend : public rendergraph::Backend {
 public:
  using CommandStream = rendergraph::CommandStream;

  std::vector<std::string> log;                      ///< Submissions with their commands, in order; "submit" ends one.
  std::vector<VkImageMemoryBarrier2> imageBarriers;  ///< Of all that was submitted.
  std::vector<VkMemoryBarrier2> memoryBarriers;      ///< The same.
  std::vector<VkRenderingAttachmentInfo> attachments;  ///< Colour attachments of all renderings, the same.
  std::vector<rendergraph::ResolvedBinding> bindings;  ///< Of the latest dispatch or draw.
  /// The latest dispatch, without its bindings.
  struct Dispatched {
    std::vector<std::byte> pushConstants;
    std::vector<uint32_t> specialization;
    rendergraph::Groups groups;
    VkBuffer indirect = VK_NULL_HANDLE;
    VkDeviceSize indirectOffset = 0;
  };
  Dispatched dispatched;
  std::map<uint64_t, std::string> living;  ///< Objects that were made and not destroyed, by id.
  std::map<uint64_t, uint64_t> viewed;     ///< View to image.
  VkImageAspectFlags viewedAspects = 0;    ///< Of the latest view.
  std::set<uint64_t> concurrent;           ///< Images and buffers with that sharing mode.
  std::vector<std::string> mistakes;       ///< What no backend should be asked for.
  uint32_t creations = 0;

  std::vector<rendergraph::QueueFacts> queueFacts{{}};
  bool dedicatedImages = false;  ///< The device wants memory of their own for images.
  bool silent = false;           ///< Writes nothing down, and allocates nothing for commands and submissions.
  int submitMs = 0;              ///< What a submission takes, at least.

  int failAfter = -1;  ///< Creations that still succeed; -1: all.
  /// Calls that can fail (creations, beginning and ending commands, submissions, waits) and still succeed; then one
  /// fails. -1: all succeed.
  int failCallAfter = -1;
  bool failSubmit = false;
  bool failWait = false;
  rendergraph::Misuse failWith = rendergraph::Misuse::device;

  /// One vkQueueSubmit2.
  struct Submitted {
    uint32_t queue = 0;
    VkSemaphore signal = VK_NULL_HANDLE;
    uint64_t value = 0;
    struct Wait {
      VkSemaphore semaphore;
      uint64_t value;
      VkPipelineStageFlags2 stages;
    };
    std::vector<Wait> waits;
    std::vector<std::string> lines;
    std::vector<uint64_t> buffers;
    std::set<uint64_t> uses;  ///< Objects.
    bool finished = false;
  };
  std::vector<Submitted> submissions;

  FakeBackend();
  ~FakeBackend() override;

  /// The device gets everything done.
  void finishAll();
  /// How often a line is in the log.
  std::size_t count(std::string_view line) const;
  /// Living objects whose description begins so.
  std::size_t countLiving(std::string_view beginning) const;
  template <class T>
  static T as(uint64_t id) {
    return reinterpret_cast<T>(id);
  }
  template <class T>
  static uint64_t idOf(T object) {
    return reinterpret_cast<uint64_t>(object);
  }

  // DeviceFacts
  std::span<const rendergraph::QueueFacts> queues() const override { return queueFacts; }
  rendergraph::MemoryRequirements requirements(const rendergraph::ImageDesc& desc,
                                               VkImageUsageFlags usage) const override;
  rendergraph::MemoryRequirements requirements(const rendergraph::BufferDesc& desc,
                                               VkBufferUsageFlags usage) const override;

  // Objects
  rendergraph::HeapId createHeap(VkDeviceSize size, uint32_t typeBits, rendergraph::MemoryKind memory,
                                 std::string_view name) override;
  void destroyHeap(rendergraph::HeapId heap) override { destroy(heap); }
  void* hostAddress(rendergraph::HeapId heap) override { return memory_[heap].data(); }
  VkImage createImage(const rendergraph::ImageRequest& request, rendergraph::HeapId heap, VkDeviceSize) override;
  rendergraph::DedicatedImage createDedicatedImage(const rendergraph::ImageRequest& request) override;
  void destroyImage(VkImage image) override { destroy(idOf(image)); }
  VkBuffer createBuffer(const rendergraph::BufferRequest& request, rendergraph::HeapId heap, VkDeviceSize) override;
  rendergraph::DedicatedBuffer createDedicatedBuffer(const rendergraph::BufferRequest& request) override;
  void destroyBuffer(VkBuffer buffer) override { destroy(idOf(buffer)); }
  VkImageView createView(const rendergraph::ViewDesc& desc, std::string_view name) override;
  void destroyView(VkImageView view) override { destroy(idOf(view)); }
  VkEvent createEvent(std::string_view name) override;
  void destroyEvent(VkEvent event) override { destroy(idOf(event)); }
  void resetEvent(VkEvent event) override;

  // Recorders and submission
  rendergraph::RecorderId createRecorder(uint32_t queue, std::string_view name) override;
  void destroyRecorder(rendergraph::RecorderId recorder) override;
  void resetRecorder(rendergraph::RecorderId recorder) override;
  VkSemaphore createTimeline(std::string_view name) override;
  void destroyTimeline(VkSemaphore timeline) override { destroy(idOf(timeline)); }
  uint64_t timelineValue(VkSemaphore timeline) override;
  void waitTimelines(const VkSemaphoreWaitInfo& wait) override;
  void submit(uint32_t queue, const VkSubmitInfo2& submission) override;

  // Recording
  CommandStream beginCommands(rendergraph::RecorderId recorder) override;
  void endCommands(const CommandStream& commands) override;
  void barrier(const CommandStream& commands, const VkDependencyInfo& dependency) override;
  void setEvent(const CommandStream& commands, VkEvent event, const VkDependencyInfo& dependency) override;
  void waitEvent(const CommandStream& commands, VkEvent event, const VkDependencyInfo& dependency) override;
  void beginRendering(const CommandStream& commands, const VkRenderingInfo& info) override;
  void endRendering(const CommandStream& commands) override;
  void beginLabel(const CommandStream& commands, std::string_view name) override;
  void endLabel(const CommandStream&) override {}
  void dispatch(const CommandStream& commands, const rendergraph::ResolvedDispatch& dispatch) override;
  void draw(const CommandStream& commands, const rendergraph::ResolvedDraw& draw) override;
  void copyImage(const CommandStream& commands, VkImage, VkImage, const VkImageCopy& region) override;
  void copyImageToBuffer(const CommandStream& commands, VkImage, VkBuffer, const VkBufferImageCopy&) override;
  void copyBuffer(const CommandStream& commands, VkBuffer, VkBuffer, VkDeviceSize bytes) override;
  void fillBuffer(const CommandStream& commands, VkBuffer, uint32_t word, VkDeviceSize bytes) override;
  void updateBuffer(const CommandStream& commands, VkBuffer, VkDeviceSize offset,
                    std::span<const std::byte> bytes) override;
  void clearImage(const CommandStream& commands, VkImage, const VkClearColorValue&,
                  const VkImageSubresourceRange&) override;
  void clearDepthImage(const CommandStream& commands, VkImage, float, const VkImageSubresourceRange&) override;
  void writeTimestamp(const CommandStream& commands, VkPipelineStageFlags2, VkQueryPool, uint32_t slot) override;

  // Time: slot i says i² ms.
  bool hasTimestamps(uint32_t) const override { return true; }
  double nanosecondsPerTick() const override { return 1e6; }
  VkQueryPool createTimestamps(uint32_t, std::string_view name) override;
  void destroyTimestamps(VkQueryPool pool) override { destroy(idOf(pool)); }
  void resetTimestamps(VkQueryPool, uint32_t) override {}
  void readTimestamps(VkQueryPool, uint32_t first, std::span<uint64_t> ticks) override;

 private:
  struct Commands;
  struct Recorder;
  struct Event;

  Commands& of(const CommandStream& commands);
  void note(const CommandStream& commands, std::string line, std::initializer_list<uint64_t> uses = {});
  void noteBindings(const CommandStream& commands, std::string line,
                    std::span<const rendergraph::ResolvedBinding> bound);
  void execute(Commands& commands, Submitted& submitted);
  void runEvents(const Commands& commands);
  void finish(VkSemaphore semaphore, uint64_t value);
  bool isInUse(uint64_t id) const;
  void mayFail();
  [[noreturn]] void fail(const char* reason) const;
  uint64_t create(const std::string& what);
  uint64_t createOn(rendergraph::HeapId heap, const std::string& what, bool isConcurrent);
  void destroy(uint64_t id);

  rendergraph::NominalDevice nominal_;
  std::map<uint64_t, std::vector<std::byte>> memory_;
  std::map<uint64_t, uint64_t> parents_;
  std::map<uint64_t, std::unique_ptr<Recorder>> recorders_;
  std::map<uint64_t, Event> events_;
  std::map<uint64_t, uint64_t> promised_;  // Timeline to the highest value that a submission will signal.
  std::map<uint64_t, uint64_t> reached_;
  std::unique_ptr<Commands> hosts_;  // Stands for all command buffers of the host.
  uint64_t lastId_ = 1000;
};

}  // namespace lensgraph
