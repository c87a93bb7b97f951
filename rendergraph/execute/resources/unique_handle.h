// Backend objects that destroy themselves.
#pragma once

#include <utility>

#include "rendergraph/backend.h"

namespace lensgraph::rendergraph {

template <class T, void (Backend::*Destroy)(T)>
class UniqueHandle {
 public:
  UniqueHandle() = default;
  UniqueHandle(Backend& backend, T object) : backend_(&backend), object_(object) {}
  UniqueHandle(UniqueHandle&& other) noexcept : backend_(other.backend_), object_(std::exchange(other.object_, T{})) {}
  UniqueHandle& operator=(UniqueHandle&& other) noexcept {
    std::swap(backend_, other.backend_);
    std::swap(object_, other.object_);
    return *this;
  }
  ~UniqueHandle() {
    if (object_ != T{}) (backend_->*Destroy)(object_);
  }
  T get() const { return object_; }
  explicit operator bool() const { return object_ != T{}; }

 private:
  Backend* backend_ = nullptr;
  T object_{};
};

using UniqueHeap = UniqueHandle<HeapId, &Backend::destroyHeap>;
using UniqueImage = UniqueHandle<VkImage, &Backend::destroyImage>;
using UniqueBuffer = UniqueHandle<VkBuffer, &Backend::destroyBuffer>;
using UniqueView = UniqueHandle<VkImageView, &Backend::destroyView>;
using UniqueEvent = UniqueHandle<VkEvent, &Backend::destroyEvent>;
using UniqueRecorder = UniqueHandle<RecorderId, &Backend::destroyRecorder>;
using UniqueTimeline = UniqueHandle<VkSemaphore, &Backend::destroyTimeline>;
using UniqueTimestamps = UniqueHandle<VkQueryPool, &Backend::destroyTimestamps>;

}  // namespace lensgraph::rendergraph
