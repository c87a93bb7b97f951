// The thread pool: one list of numbers, taken under one lock. Its jobs are few and long (a part of a frame's recording).
#include "rendergraph/jobs.h"

#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

namespace lensgraph::rendergraph {

struct ThreadPool::State {
  std::mutex mutex;
  std::condition_variable work, done;
  Job job;
  uint32_t next = 0, count = 0;  // Numbers next … count - 1 are not taken yet.
  uint32_t unfinished = 0;
  bool ending = false;
  std::vector<std::thread> threads;

  /// Takes numbers until none is left. The lock is held on entry and on return.
  void take(std::unique_lock<std::mutex>& lock) {
    while (next < count) {
      const uint32_t number = next++;
      const Job current = job;
      lock.unlock();
      current(number);
      lock.lock();
      if (--unfinished == 0) done.notify_all();
    }
  }

  void serve() {
    std::unique_lock lock(mutex);
    for (;;) {
      work.wait(lock, [&] { return ending || next < count; });
      if (ending) return;
      take(lock);
    }
  }
};

ThreadPool::ThreadPool(uint32_t threads) : state_(std::make_unique<State>()) {
  for (uint32_t i = 1; i < threads; ++i) state_->threads.emplace_back([state = state_.get()] { state->serve(); });
}

ThreadPool::~ThreadPool() {
  {
    const std::scoped_lock lock(state_->mutex);
    state_->ending = true;
  }
  state_->work.notify_all();
  for (std::thread& thread : state_->threads) thread.join();
}

uint32_t ThreadPool::threads() const {
  return static_cast<uint32_t>(state_->threads.size()) + 1;
}

void ThreadPool::run(uint32_t count, Job job) {
  std::unique_lock lock(state_->mutex);
  state_->job = job;
  state_->next = 0;
  state_->count = state_->unfinished = count;
  state_->work.notify_all();
  state_->take(lock);
  state_->done.wait(lock, [&] { return state_->unfinished == 0; });
}

}  // namespace lensgraph::rendergraph
