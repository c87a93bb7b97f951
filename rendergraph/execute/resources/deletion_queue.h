// Deletion queue: keeps released objects alive until every frame that may use them has finished.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace lensgraph::rendergraph {

class DeletionQueue {
 public:
  /// Objects added from now on are needed by frames up to this one.
  void setLastUser(uint64_t frame) { lastUser_ = frame; }
  /// Keeps the object until release() is told of its last user.
  template <class Object>
  void add(Object object) {
    objects_.push_back({lastUser_, std::make_shared<Object>(std::move(object))});
  }
  /// Destroys what only frames up to this one needed.
  void release(uint64_t finishedFrame) {
    std::erase_if(objects_, [&](const Entry& entry) { return entry.lastUser <= finishedFrame; });
  }

 private:
  struct Entry {
    uint64_t lastUser;
    std::shared_ptr<void> object;
  };
  std::vector<Entry> objects_;
  uint64_t lastUser_ = 0;
};

}  // namespace lensgraph::rendergraph
