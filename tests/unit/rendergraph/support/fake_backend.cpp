// Keeps a log of every call, and a list of the mistakes that a validation layer would report.
#include "support/fake_backend.h"

#include <algorithm>
#include <chrono>
#include <thread>

namespace lensgraph {

using rendergraph::ResolvedBinding;

namespace {

/// Handles up to here are command buffers of the host.
constexpr uint64_t kHostHandles = 1000;

std::string textOf(const VkDependencyInfo& dependency) {
  std::string text = "m" + std::to_string(dependency.memoryBarrierCount);
  for (uint32_t i = 0; i < dependency.imageMemoryBarrierCount; ++i) {
    const VkImageMemoryBarrier2& b = dependency.pImageMemoryBarriers[i];
    text += " i" + std::to_string(FakeBackend::idOf(b.image)) + "," + std::to_string(b.srcStageMask) + "," +
            std::to_string(b.dstStageMask) + "," + std::to_string(b.oldLayout) + "," + std::to_string(b.newLayout);
  }
  for (uint32_t i = 0; i < dependency.bufferMemoryBarrierCount; ++i) {
    const VkBufferMemoryBarrier2& b = dependency.pBufferMemoryBarriers[i];
    text += " b" + std::to_string(FakeBackend::idOf(b.buffer)) + "," + std::to_string(b.srcStageMask) + "," +
            std::to_string(b.dstStageMask);
  }
  return text;
}

}  // namespace

struct FakeBackend::Commands {
  uint32_t queue = 0;
  bool open = false, pending = false, rendering = false;
  std::vector<std::string> lines;
  std::set<uint64_t> uses;
  std::vector<VkImageMemoryBarrier2> imageBarriers;
  std::vector<VkMemoryBarrier2> memoryBarriers;
  std::vector<VkRenderingAttachmentInfo> attachments;
  std::vector<ResolvedBinding> bindings;
  struct EventCommand {
    uint64_t event;
    bool sets;
    std::string dependency;
  };
  std::vector<EventCommand> events;
  std::vector<std::string> mistakes;

  void clear() {
    open = pending = rendering = false;
    lines.clear();
    uses.clear();
    imageBarriers.clear();
    memoryBarriers.clear();
    attachments.clear();
    bindings.clear();
    events.clear();
    mistakes.clear();
  }
};

struct FakeBackend::Recorder {
  uint32_t queue = 0;
  std::vector<std::unique_ptr<Commands>> buffers;
  std::size_t used = 0;
};

struct FakeBackend::Event {
  bool set = false;
  std::string dependency;
};

FakeBackend::FakeBackend() : hosts_(std::make_unique<Commands>()) {}
FakeBackend::~FakeBackend() = default;

void FakeBackend::finishAll() {
  for (Submitted& submitted : submissions) submitted.finished = true;
  reached_ = promised_;
}

std::size_t FakeBackend::count(std::string_view line) const {
  return static_cast<std::size_t>(std::ranges::count(log, line));
}

std::size_t FakeBackend::countLiving(std::string_view beginning) const {
  return static_cast<std::size_t>(
      std::ranges::count_if(living, [&](const auto& object) { return object.second.starts_with(beginning); }));
}

rendergraph::MemoryRequirements FakeBackend::requirements(const rendergraph::ImageDesc& desc,
                                                          VkImageUsageFlags usage) const {
  auto needs = nominal_.requirements(desc, usage);
  needs.dedicated = dedicatedImages;
  return needs;
}
rendergraph::MemoryRequirements FakeBackend::requirements(const rendergraph::BufferDesc& desc,
                                                          VkBufferUsageFlags usage) const {
  return nominal_.requirements(desc, usage);
}

// ---- Objects

void FakeBackend::fail(const char* reason) const {
  throw rendergraph::GraphError(
      {{.misuse = failWith, .pass = {}, .resource = {}, .reason = reason, .remedy = {}, .where = {}}});
}

void FakeBackend::mayFail() {
  if (failCallAfter < 0) return;
  if (failCallAfter-- == 0) fail("injected failure");
}

uint64_t FakeBackend::create(const std::string& what) {
  if (failAfter == 0) fail("out of memory");
  if (failAfter > 0) --failAfter;
  mayFail();
  ++creations;
  living[++lastId_] = what;
  return lastId_;
}

uint64_t FakeBackend::createOn(rendergraph::HeapId heap, const std::string& what, bool isConcurrent) {
  if (!living.contains(heap)) mistakes.push_back(what + " on a dead heap");
  const uint64_t id = create(what);
  parents_[id] = heap;
  if (isConcurrent) concurrent.insert(id);
  return id;
}

bool FakeBackend::isInUse(uint64_t id) const {
  return std::ranges::any_of(submissions, [&](const Submitted& s) { return !s.finished && s.uses.contains(id); });
}

void FakeBackend::destroy(uint64_t id) {
  if (isInUse(id)) mistakes.push_back("destroyed while the device uses it: " + living[id]);
  if (living.erase(id) == 0) mistakes.push_back("destroyed twice, or never made");
  for (const auto& [child, parent] : parents_) {
    if (parent == id && living.contains(child)) mistakes.push_back("heap destroyed before " + living[child]);
  }
  for (const auto& [view, image] : viewed) {
    if (image == id && living.contains(view)) mistakes.push_back("image destroyed before its view");
  }
}

rendergraph::HeapId FakeBackend::createHeap(VkDeviceSize size, uint32_t, rendergraph::MemoryKind memory,
                                            std::string_view) {
  const bool device = memory == rendergraph::MemoryKind::device;
  const uint64_t id = create(device ? "heap" : "host heap");
  if (!device) memory_[id].resize(size);
  return id;
}

VkImage FakeBackend::createImage(const rendergraph::ImageRequest& request, rendergraph::HeapId heap, VkDeviceSize) {
  return as<VkImage>(createOn(heap, "image " + std::string(request.name), request.concurrent));
}

rendergraph::DedicatedImage FakeBackend::createDedicatedImage(const rendergraph::ImageRequest& request) {
  const uint64_t heap = create("dedicated heap");
  try {
    return {heap, createImage(request, heap, 0)};
  } catch (...) {
    living.erase(heap);
    throw;
  }
}

VkBuffer FakeBackend::createBuffer(const rendergraph::BufferRequest& request, rendergraph::HeapId heap, VkDeviceSize) {
  return as<VkBuffer>(createOn(heap, "buffer " + std::string(request.name), request.concurrent));
}

rendergraph::DedicatedBuffer FakeBackend::createDedicatedBuffer(const rendergraph::BufferRequest& request) {
  const uint64_t heap = create("dedicated heap");
  memory_[heap].resize(request.desc.size);
  try {
    return {heap, createBuffer(request, heap, 0)};
  } catch (...) {
    living.erase(heap);
    throw;
  }
}

VkImageView FakeBackend::createView(const rendergraph::ViewDesc& desc, std::string_view name) {
  const uint64_t view = create("view " + std::string(name));
  viewed[view] = idOf(desc.image);
  viewedAspects = desc.range.aspects;
  return as<VkImageView>(view);
}

VkEvent FakeBackend::createEvent(std::string_view name) {
  const uint64_t id = create("event " + std::string(name));
  events_[id] = {};
  return as<VkEvent>(id);
}

void FakeBackend::resetEvent(VkEvent event) {
  if (isInUse(idOf(event))) mistakes.emplace_back("event reset while the device uses it");
  events_[idOf(event)] = {};
}

VkQueryPool FakeBackend::createTimestamps(uint32_t, std::string_view name) {
  return as<VkQueryPool>(create(std::string(name)));
}

void FakeBackend::readTimestamps(VkQueryPool, uint32_t first, std::span<uint64_t> ticks) {
  for (std::size_t i = 0; i < ticks.size(); ++i) ticks[i] = (first + i) * (first + i);
}

// ---- Recorders

rendergraph::RecorderId FakeBackend::createRecorder(uint32_t queue, std::string_view name) {
  const uint64_t id = create("recorder " + std::string(name));
  recorders_[id] = std::make_unique<Recorder>();
  recorders_[id]->queue = queue;
  return id;
}

void FakeBackend::destroyRecorder(rendergraph::RecorderId recorder) {
  for (const auto& commands : recorders_.at(recorder)->buffers) {
    if (commands->pending) mistakes.emplace_back("recorder destroyed while the device executes its commands");
  }
  recorders_.erase(recorder);
  destroy(recorder);
}

void FakeBackend::resetRecorder(rendergraph::RecorderId id) {
  Recorder& recorder = *recorders_.at(id);
  for (const auto& commands : recorder.buffers) {
    if (commands->pending) mistakes.emplace_back("recorder reset while the device executes its commands");
    commands->clear();
  }
  recorder.used = 0;
}

// ---- Submission

VkSemaphore FakeBackend::createTimeline(std::string_view name) {
  const uint64_t id = create("timeline " + std::string(name));
  promised_[id] = reached_[id] = 0;
  return as<VkSemaphore>(id);
}

uint64_t FakeBackend::timelineValue(VkSemaphore timeline) {
  return reached_.at(idOf(timeline));
}

void FakeBackend::finish(VkSemaphore semaphore, uint64_t value) {
  reached_[idOf(semaphore)] = std::max(reached_[idOf(semaphore)], value);
  for (Submitted& submitted : submissions) {
    if (submitted.finished || submitted.signal != semaphore || submitted.value > value) continue;
    submitted.finished = true;
    for (const uint64_t buffer : submitted.buffers) as<Commands*>(buffer)->pending = false;
    for (const Submitted::Wait& wait : submitted.waits) finish(wait.semaphore, wait.value);
  }
}

void FakeBackend::waitTimelines(const VkSemaphoreWaitInfo& wait) {
  if (failWait) fail("the wait failed");
  mayFail();
  for (uint32_t i = 0; i < wait.semaphoreCount; ++i) {
    if (wait.pValues[i] > promised_.at(idOf(wait.pSemaphores[i]))) mistakes.emplace_back("the host would wait forever");
    finish(wait.pSemaphores[i], wait.pValues[i]);
  }
}

void FakeBackend::runEvents(const Commands& commands) {
  for (const auto& command : commands.events) {
    Event& event = events_[command.event];
    if (command.sets) {
      if (event.set) mistakes.emplace_back("event set twice");
      event = {true, command.dependency};
    } else {
      if (!event.set) mistakes.emplace_back("event waited for before it is set");
      if (event.dependency != command.dependency) mistakes.emplace_back("event set and waited for differently");
    }
  }
}

void FakeBackend::execute(Commands& commands, Submitted& submitted) {
  if (commands.open) mistakes.emplace_back("submitted before it ended");
  if (commands.pending) mistakes.emplace_back("submitted twice");
  if (commands.queue != submitted.queue) mistakes.emplace_back("submitted to another queue than it was recorded for");
  commands.pending = true;
  submitted.buffers.push_back(idOf(&commands));
  submitted.lines.insert(submitted.lines.end(), commands.lines.begin(), commands.lines.end());
  submitted.uses.insert(commands.uses.begin(), commands.uses.end());
  log.emplace_back("begin");
  log.insert(log.end(), commands.lines.begin(), commands.lines.end());
  imageBarriers.insert(imageBarriers.end(), commands.imageBarriers.begin(), commands.imageBarriers.end());
  memoryBarriers.insert(memoryBarriers.end(), commands.memoryBarriers.begin(), commands.memoryBarriers.end());
  attachments.insert(attachments.end(), commands.attachments.begin(), commands.attachments.end());
  mistakes.insert(mistakes.end(), commands.mistakes.begin(), commands.mistakes.end());
  if (!commands.bindings.empty()) bindings = commands.bindings;
  runEvents(commands);
}

void FakeBackend::submit(uint32_t queue, const VkSubmitInfo2& info) {
  if (submitMs > 0) std::this_thread::sleep_for(std::chrono::milliseconds(submitMs));
  if (failSubmit) fail("device lost");
  mayFail();
  const VkSemaphoreSubmitInfo& signal = info.pSignalSemaphoreInfos[0];
  if (signal.value <= promised_.at(idOf(signal.semaphore))) mistakes.emplace_back("a timeline goes backwards");
  promised_[idOf(signal.semaphore)] = signal.value;
  if (silent) return;
  Submitted submitted{.queue = queue, .signal = signal.semaphore, .value = signal.value};
  for (uint32_t i = 0; i < info.waitSemaphoreInfoCount; ++i) {
    const VkSemaphoreSubmitInfo& wait = info.pWaitSemaphoreInfos[i];
    if (wait.value > promised_.at(idOf(wait.semaphore))) mistakes.emplace_back("waits for what is not submitted yet");
    submitted.waits.push_back({wait.semaphore, wait.value, wait.stageMask});
  }
  for (uint32_t i = 0; i < info.commandBufferInfoCount; ++i) {
    execute(*as<Commands*>(idOf(info.pCommandBufferInfos[i].commandBuffer)), submitted);
  }
  log.push_back(queue == 0 ? "submit" : "submit " + std::to_string(queue));
  submissions.push_back(std::move(submitted));
}

// ---- Recording: touches only what belongs to the stream, so that a thread sanitizer sees the executor's own faults.

FakeBackend::CommandStream FakeBackend::beginCommands(rendergraph::RecorderId id) {
  Recorder& recorder = *recorders_.at(id);
  if (!silent) mayFail();
  if (recorder.used == recorder.buffers.size()) {
    recorder.buffers.push_back(std::make_unique<Commands>());
    recorder.buffers.back()->queue = recorder.queue;
  }
  Commands& commands = *recorder.buffers[recorder.used++];
  commands.open = true;
  return {as<VkCommandBuffer>(idOf(&commands)), id};
}

FakeBackend::Commands& FakeBackend::of(const CommandStream& commands) {
  return idOf(commands.buffer) < kHostHandles ? *hosts_ : *as<Commands*>(idOf(commands.buffer));
}

void FakeBackend::endCommands(const CommandStream& commands) {
  if (!silent) mayFail();
  of(commands).open = false;
}

void FakeBackend::note(const CommandStream& stream, std::string line, std::initializer_list<uint64_t> uses) {
  Commands& commands = of(stream);
  commands.uses.insert(uses);
  if (&commands == hosts_.get()) {
    log.push_back(std::move(line));
  } else {
    commands.lines.push_back(std::move(line));
  }
}

void FakeBackend::barrier(const CommandStream& stream, const VkDependencyInfo& dependency) {
  if (silent) return;
  note(stream, dependency.memoryBarrierCount > 0 ? "full barrier" : "barrier");
  Commands& commands = of(stream);
  if (commands.rendering) commands.mistakes.emplace_back("barrier inside a rendering");
  for (uint32_t i = 0; i < dependency.imageMemoryBarrierCount; ++i) {
    commands.uses.insert(idOf(dependency.pImageMemoryBarriers[i].image));
    commands.imageBarriers.push_back(dependency.pImageMemoryBarriers[i]);
  }
  for (uint32_t i = 0; i < dependency.bufferMemoryBarrierCount; ++i) {
    commands.uses.insert(idOf(dependency.pBufferMemoryBarriers[i].buffer));
  }
  for (uint32_t i = 0; i < dependency.memoryBarrierCount; ++i) {
    commands.memoryBarriers.push_back(dependency.pMemoryBarriers[i]);
  }
}

void FakeBackend::setEvent(const CommandStream& stream, VkEvent event, const VkDependencyInfo& dependency) {
  if (silent) return;
  note(stream, "set event", {idOf(event)});
  if (of(stream).rendering) of(stream).mistakes.emplace_back("event set inside a rendering");
  of(stream).events.push_back({idOf(event), true, textOf(dependency)});
}

void FakeBackend::waitEvent(const CommandStream& stream, VkEvent event, const VkDependencyInfo& dependency) {
  if (silent) return;
  note(stream, "wait event", {idOf(event)});
  of(stream).events.push_back({idOf(event), false, textOf(dependency)});
}

void FakeBackend::beginRendering(const CommandStream& stream, const VkRenderingInfo& info) {
  if (silent) return;
  std::string text = "rendering " + std::to_string(info.renderArea.extent.width) + "x" +
                     std::to_string(info.renderArea.extent.height) + " layers " + std::to_string(info.layerCount);
  Commands& commands = of(stream);
  if (commands.rendering) commands.mistakes.emplace_back("a rendering inside a rendering");
  commands.rendering = true;
  for (uint32_t i = 0; i < info.colorAttachmentCount; ++i) {
    const VkRenderingAttachmentInfo& attachment = info.pColorAttachments[i];
    text += " clear " + std::to_string(static_cast<int>(attachment.clearValue.color.float32[0]));
    if (attachment.resolveMode != VK_RESOLVE_MODE_NONE) text += " resolve " + std::to_string(attachment.resolveMode);
    commands.uses.insert({idOf(attachment.imageView), idOf(attachment.resolveImageView)});
    commands.attachments.push_back(attachment);
  }
  note(stream, text);
}

void FakeBackend::endRendering(const CommandStream& stream) {
  if (silent) return;
  if (!of(stream).rendering) of(stream).mistakes.emplace_back("no rendering to end");
  of(stream).rendering = false;
  note(stream, "end rendering");
}

void FakeBackend::beginLabel(const CommandStream& stream, std::string_view name) {
  if (!silent) note(stream, "label " + std::string(name));
}

void FakeBackend::noteBindings(const CommandStream& stream, std::string line, std::span<const ResolvedBinding> bound) {
  note(stream, std::move(line));
  for (const ResolvedBinding& binding : bound) of(stream).uses.insert({idOf(binding.view), idOf(binding.buffer)});
  of(stream).bindings.assign(bound.begin(), bound.end());
}

void FakeBackend::dispatch(const CommandStream& stream, const rendergraph::ResolvedDispatch& dispatch) {
  if (silent) return;
  noteBindings(stream, "dispatch " + std::string(dispatch.program.name), dispatch.bindings);
  dispatched = {.pushConstants = {dispatch.pushConstants.begin(), dispatch.pushConstants.end()},
                .specialization = {dispatch.specialization.begin(), dispatch.specialization.end()},
                .groups = dispatch.groups,
                .indirect = dispatch.indirect,
                .indirectOffset = dispatch.indirectOffset};
}

void FakeBackend::draw(const CommandStream& stream, const rendergraph::ResolvedDraw& draw) {
  if (silent) return;
  std::string line = "draw " + std::string(draw.program.name);
  if (draw.samples != VK_SAMPLE_COUNT_1_BIT) line += " samples " + std::to_string(draw.samples);
  if (!of(stream).rendering) of(stream).mistakes.emplace_back("draw outside a rendering");
  noteBindings(stream, std::move(line), draw.bindings);
}

void FakeBackend::copyImage(const CommandStream& stream, VkImage from, VkImage to, const VkImageCopy& region) {
  if (silent) return;
  note(stream, "copy image mip " + std::to_string(region.srcSubresource.mipLevel), {idOf(from), idOf(to)});
}
void FakeBackend::copyImageToBuffer(const CommandStream& stream, VkImage from, VkBuffer to, const VkBufferImageCopy&) {
  if (!silent) note(stream, "copy image to buffer", {idOf(from), idOf(to)});
}
void FakeBackend::copyBuffer(const CommandStream& stream, VkBuffer from, VkBuffer to, VkDeviceSize bytes) {
  if (!silent) note(stream, "copy buffer " + std::to_string(bytes), {idOf(from), idOf(to)});
}
void FakeBackend::fillBuffer(const CommandStream& stream, VkBuffer to, uint32_t word, VkDeviceSize bytes) {
  if (silent) return;
  note(stream, "fill " + std::to_string(word) + (bytes == VK_WHOLE_SIZE ? "" : " x" + std::to_string(bytes)),
       {idOf(to)});
}
void FakeBackend::updateBuffer(const CommandStream& stream, VkBuffer to, VkDeviceSize offset,
                               std::span<const std::byte> bytes) {
  if (!silent) note(stream, "update " + std::to_string(offset) + "+" + std::to_string(bytes.size()), {idOf(to)});
}
void FakeBackend::clearImage(const CommandStream& stream, VkImage image, const VkClearColorValue&,
                             const VkImageSubresourceRange&) {
  if (!silent) note(stream, "clear", {idOf(image)});
}
void FakeBackend::clearDepthImage(const CommandStream& stream, VkImage image, float, const VkImageSubresourceRange&) {
  if (!silent) note(stream, "clear depth", {idOf(image)});
}
void FakeBackend::writeTimestamp(const CommandStream& stream, VkPipelineStageFlags2, VkQueryPool pool, uint32_t slot) {
  if (!silent) note(stream, "timestamp " + std::to_string(slot), {idOf(pool)});
}

}  // namespace lensgraph
