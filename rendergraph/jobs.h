// Work on several threads: what the executor asks of a host's job system, and a small one for hosts without.
#pragma once

#include <cstdint>
#include <memory>

namespace lensgraph::rendergraph {

/// A job to be called with each number from 0 to count - 1, once. A light reference: valid during Jobs::run().
struct Job {
  void (*call)(void* self, uint32_t number) = nullptr;
  void* self = nullptr;
  void operator()(uint32_t number) const { call(self, number); }

  /// Of a callable that is alive as long as the job is.
  template <class Callable>
  static Job of(Callable& callable) {
    return {[](void* self, uint32_t number) { (*static_cast<Callable*>(self))(number); }, &callable};
  }
};

class Jobs {
 public:
  virtual ~Jobs() = default;
  /// Calls job(0) … job(count - 1), in any order, on any threads, any number at once (one after the other is right
  /// too), and returns when all have returned. What they wrote is visible to the caller. Jobs do not throw.
  virtual void run(uint32_t count, Job job) = 0;
};

/// Threads that sleep between runs. The thread that calls run() works too.
class ThreadPool final : public Jobs {
 public:
  /// `threads`: in all, the caller's included; at least 1.
  explicit ThreadPool(uint32_t threads);
  ~ThreadPool() override;
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;
  uint32_t threads() const;
  void run(uint32_t count, Job job) override;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace lensgraph::rendergraph
