// Which passes use which resources, counted from the accesses; and the bytes alive, updated pass by pass.
#include "rendergraph/compile/schedule/live_bytes.h"

#include <algorithm>
#include <numeric>

#include "rendergraph/declare/declaration.h"

namespace lensgraph::rendergraph {

MemoryUse::MemoryUse(const Declaration& declaration, std::span<const uint8_t> alive,
                     std::span<const VkDeviceSize> bytes)
    : bytes_(bytes), userStarts_(bytes.size() + 1, 0), lasting_(bytes.size()) {
  std::vector<uint32_t> lastSeen(bytes.size(), kNone);
  resourceStarts_.push_back(0);
  for (uint32_t pass = 0; pass < declaration.passes.size(); ++pass) {
    if (alive[pass]) {
      for (const DeclaredAccess& access : declaration.accessesOfPass(pass)) {
        if (bytes[access.resource] == 0 || lastSeen[access.resource] == pass) continue;
        lastSeen[access.resource] = pass;
        resources_.push_back(access.resource);
        ++userStarts_[access.resource + 1];
      }
    }
    resourceStarts_.push_back(static_cast<uint32_t>(resources_.size()));
  }
  std::partial_sum(userStarts_.begin(), userStarts_.end(), userStarts_.begin());
  users_.resize(resources_.size());
  std::vector<uint32_t> next(userStarts_.begin(), userStarts_.end() - 1);
  for (uint32_t pass = 0; pass < declaration.passes.size(); ++pass) {
    for (uint32_t resource : ofPass(pass)) users_[next[resource]++] = pass;
  }
  for (uint32_t resource = 0; resource < bytes.size(); ++resource) {
    lasting_[resource] = declaration.resources[resource].exported;
  }
}

LiveBytes::LiveBytes(const MemoryUse& use, Direction direction) : use_(use), direction_(direction) {
  reset();
}

void LiveBytes::reset() {
  usesLeft_.resize(use_.resources());
  started_.assign(use_.resources(), 0);
  live_ = 0;
  for (uint32_t resource = 0; resource < use_.resources(); ++resource) {
    const auto users = static_cast<uint32_t>(use_.usersOf(resource).size());
    const bool lasting = use_.lasting(resource) && users > 0;
    usesLeft_[resource] = users + (lasting && direction_ == Direction::forward);
    if (!lasting || direction_ == Direction::forward) continue;
    started_[resource] = 1;
    live_ += use_.bytes(resource);
  }
}

int64_t peakBytes(const MemoryUse& use, std::span<const uint32_t> order) {
  LiveBytes bytes(use, Direction::forward);
  int64_t peak = 0;
  for (uint32_t pass : order) {
    bytes.begin(pass);
    peak = std::max(peak, bytes.live());
    bytes.end(pass);
  }
  return peak;
}

}  // namespace lensgraph::rendergraph
