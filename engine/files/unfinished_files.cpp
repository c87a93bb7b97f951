// A fixed table of names: no lock and no allocation, since a signal handler may run in the middle of either.
#include "engine/files/unfinished_files.h"

#include <unistd.h>

#include <array>
#include <atomic>
#include <cstring>

namespace lensgraph::engine {
namespace {

// A slot's name is complete while its state is `used`.
enum class State { empty, beingWritten, used };

struct Slot {
  std::atomic<State> state{State::empty};
  std::array<char, 4096> name{};
};
static_assert(std::atomic<State>::is_always_lock_free, "a signal handler reads it");

std::array<Slot, 16> slots;

}  // namespace

int noteUnfinished(const std::string& name) noexcept {
  if (name.size() >= slots[0].name.size()) return -1;
  for (std::size_t i = 0; i < slots.size(); ++i) {
    State expected = State::empty;
    if (!slots[i].state.compare_exchange_strong(expected, State::beingWritten)) continue;
    std::memcpy(slots[i].name.data(), name.c_str(), name.size() + 1);
    slots[i].state = State::used;
    return static_cast<int>(i);
  }
  return -1;
}

void forgetUnfinished(int slot) noexcept {
  if (slot >= 0) slots[static_cast<std::size_t>(slot)].state = State::empty;
}

void removeUnfinishedFiles() noexcept {
  for (Slot& slot : slots) {
    if (slot.state == State::used) ::unlink(slot.name.data());
  }
}

}  // namespace lensgraph::engine
