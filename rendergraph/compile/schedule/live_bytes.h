// How many bytes are alive while passes run one after the other, in either direction of time.
#pragma once

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <span>
#include <vector>

namespace lensgraph::rendergraph {

struct Declaration;

/// Which passes use which of the resources that cost memory.
class MemoryUse {
 public:
  /// `alive`: by pass. `bytes`: by resource, 0 for those that cost nothing; must outlive this.
  MemoryUse(const Declaration& declaration, std::span<const uint8_t> alive, std::span<const VkDeviceSize> bytes);

  uint32_t resources() const { return static_cast<uint32_t>(bytes_.size()); }
  int64_t bytes(uint32_t resource) const { return static_cast<int64_t>(bytes_[resource]); }
  /// Distinct ones, in order of declaration.
  std::span<const uint32_t> ofPass(uint32_t pass) const {
    return {resources_.data() + resourceStarts_[pass], resources_.data() + resourceStarts_[pass + 1]};
  }
  std::span<const uint32_t> usersOf(uint32_t resource) const {
    return {users_.data() + userStarts_[resource], users_.data() + userStarts_[resource + 1]};
  }
  /// What leaves the graph stays until the end.
  bool lasting(uint32_t resource) const { return lasting_[resource] != 0; }

 private:
  std::span<const VkDeviceSize> bytes_;
  std::vector<uint32_t> resourceStarts_, resources_;  // By pass.
  std::vector<uint32_t> userStarts_, users_;          // By resource.
  std::vector<uint8_t> lasting_;
};

enum class Direction : uint8_t { forward, backward };

class LiveBytes {
 public:
  LiveBytes(const MemoryUse& use, Direction direction);
  /// To the state before anything ran.
  void reset();

  int64_t live() const { return live_; }
  bool started(uint32_t resource) const { return started_[resource] != 0; }
  /// Uses to come; one more than passes for what stays.
  uint32_t usesLeft(uint32_t resource) const { return usesLeft_[resource]; }

  /// Bytes that come alive with a pass, and that die after it.
  int64_t added(uint32_t pass) const {
    int64_t sum = 0;
    for (uint32_t resource : use_.ofPass(pass)) {
      if (!started_[resource]) sum += use_.bytes(resource);
    }
    return sum;
  }
  int64_t freed(uint32_t pass) const {
    int64_t sum = 0;
    for (uint32_t resource : use_.ofPass(pass)) {
      if (usesLeft_[resource] == 1) sum += use_.bytes(resource);
    }
    return sum;
  }
  void begin(uint32_t pass) {
    live_ += added(pass);
    for (uint32_t resource : use_.ofPass(pass)) started_[resource] = 1;
  }
  void end(uint32_t pass) {
    live_ -= freed(pass);
    for (uint32_t resource : use_.ofPass(pass)) --usesLeft_[resource];
  }

 private:
  const MemoryUse& use_;
  Direction direction_;
  std::vector<uint32_t> usesLeft_;
  std::vector<uint8_t> started_;
  int64_t live_ = 0;
};

/// Largest number of bytes alive when the passes run in this order.
int64_t peakBytes(const MemoryUse& use, std::span<const uint32_t> order);

}  // namespace lensgraph::rendergraph
