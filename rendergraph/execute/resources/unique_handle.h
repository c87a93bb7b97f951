// Backend objects that destroy themselves.
#pragma once

#include <utility>

#include "rendergraph/backend.h"

namespace lensgraph::rendergraph {

template <class T, void (Backend::*Destroy)(T)>
class Owned {
 public:
  Owned() = default;
  Owned(Backend& backend, T object) : backend_(&backend), object_(object) {}
  Owned(Owned&& other) noexcept : backend_(other.backend_), object_(std::exchange(other.object_, T{})) {}
  Owned& operator=(Owned&& other) noexcept {
    std::swap(backend_, other.backend_);
    std::swap(object_, other.object_);
    return *this;
  }
  ~Owned() {
    if (object_ != T{}) (backend_->*Destroy)(object_);
  }
  T get() const { return object_; }
  explicit operator bool() const { return object_ != T{}; }

 private:
  Backend* backend_ = nullptr;
  T object_{};
};

using OwnedHeap = Owned<HeapId, &Backend::destroyHeap>;
using OwnedImage = Owned<VkImage, &Backend::destroyImage>;
using OwnedBuffer = Owned<VkBuffer, &Backend::destroyBuffer>;
using OwnedView = Owned<VkImageView, &Backend::destroyView>;
using OwnedEvent = Owned<VkEvent, &Backend::destroyEvent>;
using OwnedRecorder = Owned<RecorderId, &Backend::destroyRecorder>;
using OwnedTimeline = Owned<VkSemaphore, &Backend::destroyTimeline>;
using OwnedTimestamps = Owned<VkQueryPool, &Backend::destroyTimestamps>;

}  // namespace lensgraph::rendergraph
