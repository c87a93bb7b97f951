// A counter that all threads draw tiles from; the calling thread is one of them.
#include "engine/raytracer/tile_work.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace lensgraph::engine {

void runTiles(const TileWork& tileWork) {
  std::atomic<uint32_t> next = 0, done = 0;
  std::atomic<bool> isStopped = false;
  std::exception_ptr failure;
  std::mutex failureMutex;
  const auto takeTiles = [&](bool reports) {
    try {
      for (uint32_t tile = next++; tile < tileWork.tiles && !isStopped; tile = next++) {
        tileWork.work(tile);
        const uint32_t now = ++done;
        if (reports && tileWork.progress) tileWork.progress(now);
      }
    } catch (...) {
      const std::scoped_lock lock(failureMutex);
      if (!failure) failure = std::current_exception();
      isStopped = true;
    }
  };
  const uint32_t wanted = tileWork.threads == 0 ? std::max(std::thread::hardware_concurrency(), 1u) : tileWork.threads;
  {
    std::vector<std::jthread> helpers;
    for (uint32_t i = 1; i < std::min(wanted, tileWork.tiles); ++i) helpers.emplace_back([&] { takeTiles(false); });
    takeTiles(true);
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace lensgraph::engine
