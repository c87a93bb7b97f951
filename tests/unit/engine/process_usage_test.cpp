// Processor time and memory of this process.
#include "engine/process_usage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <thread>
#include <vector>

namespace lensgraph::engine {
namespace {

/// Keeps a processor busy until its thread has used so much of it.
void burn(double ms) {
  const auto used = [] {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) * 1e3 + static_cast<double>(time.tv_nsec) * 1e-6;
  };
  const double start = used();
  while (used() - start < ms) {
  }
}

TEST(ProcessUsage, CountsTheTimeOfAllThreads) {
  const double before = processCpuMs();
  std::vector<std::thread> threads;
  for (int i = 0; i < 3; ++i) threads.emplace_back([] { burn(20.0); });
  for (auto& thread : threads) thread.join();
  const double used = processCpuMs() - before;
  EXPECT_GE(used, 60.0);
  EXPECT_LT(used, 120.0);
}

TEST(ProcessUsage, WaitingCostsNothing) {
  // Threads that libraries start may be at work in one of these moments, but not in all.
  double least = 1e9;
  for (int attempt = 0; attempt < 10; ++attempt) {
    const double before = processCpuMs();
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    least = std::min(least, processCpuMs() - before);
  }
  EXPECT_LT(least, 20.0);
}

TEST(ProcessUsage, PeakMemoryGrowsWithWhatIsTouched) {
  const uint64_t before = peakProcessBytes();
  EXPECT_GT(before, 1'000'000u);
  constexpr std::size_t kBytes = 200'000'000;
  std::vector<char> bytes(kBytes, 1);
  EXPECT_GE(peakProcessBytes(), static_cast<uint64_t>(bytes[kBytes / 2]) * kBytes);
}

}  // namespace
}  // namespace lensgraph::engine
