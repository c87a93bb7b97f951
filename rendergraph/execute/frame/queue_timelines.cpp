// Submits with one signal each, and turns a failed wait into an error that says where the device stopped.
#include "rendergraph/execute/frame/queue_timelines.h"

#include <algorithm>
#include <string>
#include <utility>

#include "rendergraph/error.h"

namespace lensgraph::rendergraph {

void QueueTimelines::open() {
  const std::size_t count = backend_.queues().size();
  queues_.reserve(count);
  while (queues_.size() < count) {
    const std::string name = "graph queue " + std::to_string(queues_.size());
    queues_.push_back({.semaphore = UniqueTimeline(backend_, backend_.createTimeline(name)), .value = 0});
  }
}

uint64_t QueueTimelines::submit(uint32_t queue, VkSubmitInfo2 submission) {
  Timeline& timeline = queues_[queue];
  VkSemaphoreSubmitInfo signal{};
  signal.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO;
  signal.semaphore = timeline.semaphore.get();
  signal.value = timeline.value + 1;
  signal.stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  submission.signalSemaphoreInfoCount = 1;
  submission.pSignalSemaphoreInfos = &signal;
  backend_.submit(queue, submission);
  return ++timeline.value;
}

bool QueueTimelines::isFinished(const SentSubmission& sent) const {
  return backend_.timelineValue(semaphore(sent.queue)) >= sent.value;
}

/// The first submission that the device has not finished; the last one when all seem finished, null when there is none
/// or nothing can be known.
const SentSubmission* QueueTimelines::firstUnfinished(const FrameInFlight& frame) const {
  for (const SentSubmission& sent : frame.sent) {
    try {
      if (!isFinished(sent)) return &sent;
    } catch (const GraphError&) {
      break;  // Not even that can be known.
    }
  }
  return frame.sent.empty() ? nullptr : &frame.sent.back();
}

void QueueTimelines::wait(const FrameInFlight& frame, std::span<const SentSubmission> sent) {
  if (sent.empty()) return;
  waitedSemaphores_.assign(queues_.size(), VK_NULL_HANDLE);
  waitedValues_.assign(queues_.size(), 0);
  for (uint32_t queue = 0; queue < queues_.size(); ++queue) waitedSemaphores_[queue] = semaphore(queue);
  for (const SentSubmission& one : sent) waitedValues_[one.queue] = std::max(waitedValues_[one.queue], one.value);
  VkSemaphoreWaitInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO;
  info.semaphoreCount = static_cast<uint32_t>(waitedSemaphores_.size());
  info.pSemaphores = waitedSemaphores_.data();
  info.pValues = waitedValues_.data();
  try {
    backend_.waitTimelines(info);
  } catch (const GraphError& error) {
    plans_.distrust();
    const SentSubmission* stopped = firstUnfinished(frame);
    std::vector<GraphError::Problem> problems = error.problems();
    if (stopped != nullptr && stopped->hasSteps && problems.front().pass.empty()) {
      const std::string& first = frame.capture.passes[stopped->firstStep].name;
      const std::string& last = frame.capture.passes[stopped->lastStep].name;
      problems.front().pass = first;
      if (stopped->firstStep != stopped->lastStep) {
        problems.front().reason += ", between the passes '" + first + "' and '" + last + "'";
      }
    }
    throw GraphError(std::move(problems));
  }
}

}  // namespace lensgraph::rendergraph
