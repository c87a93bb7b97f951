// Recorders, timelines, submission, events and time for the graph.
#include <algorithm>

#include "engine/graph/graph_backend.h"
#include "engine/graph/graph_error.h"
#include "engine/vulkan/vulkan_functions.h"

namespace lensgraph::engine {

// ---- Recorders

GraphBackend::RecorderId GraphBackend::createRecorder(uint32_t queue, std::string_view name) {
  return withGraphErrors({}, [&] {
    recorders_.push_back(std::make_unique<Recorder>(CommandPool(device_, queue, name), DescriptorRing(device_),
                                                    SetWriter(), std::vector<BindingKind>()));
    return reinterpret_cast<RecorderId>(recorders_.back().get());
  });
}

void GraphBackend::destroyRecorder(RecorderId recorder) {
  std::erase_if(recorders_, [&](const auto& one) { return reinterpret_cast<RecorderId>(one.get()) == recorder; });
}

void GraphBackend::resetRecorder(RecorderId recorder) {
  Recorder& one = recorderOf({VK_NULL_HANDLE, recorder});
  withGraphErrors({}, [&] {
    one.pool.reset();
    one.descriptors.reset();
  });
}

// ---- Timelines

VkSemaphore GraphBackend::createTimeline(std::string_view name) {
  VkSemaphoreTypeCreateInfo type{VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO};
  type.semaphoreType = VK_SEMAPHORE_TYPE_TIMELINE;
  VkSemaphoreCreateInfo info{VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO, &type};
  VkSemaphore semaphore = VK_NULL_HANDLE;
  checkForGraph(device_.vk().vkCreateSemaphore(device_.handle(), &info, nullptr, &semaphore), "vkCreateSemaphore",
                name);
  device_.setName(VK_OBJECT_TYPE_SEMAPHORE, reinterpret_cast<uint64_t>(semaphore), name);
  return semaphore;
}

void GraphBackend::destroyTimeline(VkSemaphore timeline) {
  std::erase_if(sent_, [&](const SentFence& sent) { return sent.timeline == timeline; });
  device_.vk().vkDestroySemaphore(device_.handle(), timeline, nullptr);
}

uint64_t GraphBackend::timelineValue(VkSemaphore timeline) {
  uint64_t value = 0;
  checkForGraph(device_.vk().vkGetSemaphoreCounterValue(device_.handle(), timeline, &value),
                "vkGetSemaphoreCounterValue");
  return value;
}

Unique<VkFence> GraphBackend::takeFence() {
  if (!fences_.empty()) {
    Unique<VkFence> fence = std::move(fences_.back());
    fences_.pop_back();
    return fence;
  }
  const VkFenceCreateInfo info{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
  VkFence fence = VK_NULL_HANDLE;
  checkForGraph(device_.vk().vkCreateFence(device_.handle(), &info, nullptr, &fence), "vkCreateFence");
  device_.setName(VK_OBJECT_TYPE_FENCE, reinterpret_cast<uint64_t>(fence), "graph submission");
  return {device_.handle(), fence, device_.vk().vkDestroyFence};
}

// A timeline alone would do; but synchronization validation (1.3.239) does not follow it to the host, and takes what
// the host waited for to be still under way. It follows fences.
void GraphBackend::waitTimelines(const VkSemaphoreWaitInfo& wait) {
  const auto isWaitedFor = [&](const SentFence& sent) {
    for (uint32_t i = 0; i < wait.semaphoreCount; ++i) {
      if (wait.pSemaphores[i] == sent.timeline && sent.value <= wait.pValues[i]) return true;
    }
    return false;
  };
  for (SentFence& sent : sent_) {
    if (!sent.fence || !isWaitedFor(sent)) continue;
    const VkFence fence = sent.fence.get();
    checkForGraph(device_.vk().vkWaitForFences(device_.handle(), 1, &fence, VK_TRUE, UINT64_MAX), "vkWaitForFences");
    checkForGraph(device_.vk().vkResetFences(device_.handle(), 1, &fence), "vkResetFences");
    fences_.push_back(std::move(sent.fence));
  }
  std::erase_if(sent_, [](const SentFence& sent) { return !sent.fence; });
  checkForGraph(device_.vk().vkWaitSemaphores(device_.handle(), &wait, UINT64_MAX), "vkWaitSemaphores");
}

void GraphBackend::submit(uint32_t queue, const VkSubmitInfo2& submission) {
  sent_.reserve(sent_.size() + 1);  // So that nothing throws once the device has it.
  Unique<VkFence> fence = takeFence();
  checkForGraph(device_.submit(queue, submission, fence.get()), "vkQueueSubmit2");
  const VkSemaphoreSubmitInfo& signal = submission.pSignalSemaphoreInfos[0];
  sent_.push_back({signal.semaphore, signal.value, std::move(fence)});
}

// ---- Events

VkEvent GraphBackend::createEvent(std::string_view name) {
  // Not DEVICE_ONLY: the host unsets it once the frame has finished, which costs the device nothing.
  const VkEventCreateInfo info{VK_STRUCTURE_TYPE_EVENT_CREATE_INFO};
  VkEvent event = VK_NULL_HANDLE;
  checkForGraph(device_.vk().vkCreateEvent(device_.handle(), &info, nullptr, &event), "vkCreateEvent", name);
  device_.setName(VK_OBJECT_TYPE_EVENT, reinterpret_cast<uint64_t>(event), name);
  return event;
}

void GraphBackend::destroyEvent(VkEvent event) {
  device_.vk().vkDestroyEvent(device_.handle(), event, nullptr);
}

void GraphBackend::resetEvent(VkEvent event) {
  checkForGraph(device_.vk().vkResetEvent(device_.handle(), event), "vkResetEvent");
}

// ---- Time

bool GraphBackend::hasTimestamps(uint32_t queue) const {
  return device_.queues()[queue].timestampBits > 0;
}

double GraphBackend::nanosecondsPerTick() const {
  return static_cast<double>(device_.limits().timestampPeriod);
}

VkQueryPool GraphBackend::createTimestamps(uint32_t count, std::string_view name) {
  VkQueryPoolCreateInfo info{VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
  info.queryType = VK_QUERY_TYPE_TIMESTAMP;
  info.queryCount = count;
  VkQueryPool pool = VK_NULL_HANDLE;
  checkForGraph(device_.vk().vkCreateQueryPool(device_.handle(), &info, nullptr, &pool), "vkCreateQueryPool", name);
  device_.setName(VK_OBJECT_TYPE_QUERY_POOL, reinterpret_cast<uint64_t>(pool), name);
  resetTimestamps(pool, count);
  return pool;
}

void GraphBackend::destroyTimestamps(VkQueryPool pool) {
  device_.vk().vkDestroyQueryPool(device_.handle(), pool, nullptr);
}

void GraphBackend::resetTimestamps(VkQueryPool pool, uint32_t count) {
  device_.vk().vkResetQueryPool(device_.handle(), pool, 0, count);
}

void GraphBackend::readTimestamps(VkQueryPool pool, uint32_t first, std::span<uint64_t> ticks) {
  checkForGraph(device_.vk().vkGetQueryPoolResults(device_.handle(), pool, first, static_cast<uint32_t>(ticks.size()),
                                                   ticks.size_bytes(), ticks.data(), sizeof(uint64_t),
                                                   VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
                "vkGetQueryPoolResults", "timestamps");
}

}  // namespace lensgraph::engine
