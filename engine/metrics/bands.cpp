// Bands of rows and the threads that work on them: see bands.h.
#include "engine/metrics/bands.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>

namespace lensgraph::engine {

std::vector<Band> bandsOf(uint32_t height, uint32_t rows) {
  std::vector<Band> bands;
  for (uint32_t first = 0; first < height; first += std::min(rows, height - first)) {
    bands.push_back({first, first + std::min(rows, height - first)});
  }
  return bands;
}

void forEachInParallel(size_t count, const std::function<void(size_t)>& work) {
  std::atomic<size_t> next = 0;
  std::exception_ptr failure;
  std::mutex failureGuard;
  const auto run = [&] {
    try {
      for (size_t i = next++; i < count; i = next++) work(i);
    } catch (...) {
      next = count;  // The other threads take no further work.
      const std::lock_guard lock(failureGuard);
      if (!failure) failure = std::current_exception();
    }
  };
  const size_t processors = std::max(1u, std::thread::hardware_concurrency());
  std::vector<std::jthread> helpers;
  for (size_t i = 1; i < std::min(processors, count); ++i) helpers.emplace_back(run);
  run();
  helpers.clear();  // Waits for them.
  if (failure) std::rethrow_exception(failure);
}

}  // namespace lensgraph::engine
