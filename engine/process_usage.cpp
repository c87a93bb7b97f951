// Asks the operating system (POSIX): see process_usage.h.
#include "engine/process_usage.h"

#include <sys/resource.h>

#include <ctime>

namespace lensgraph::engine {

double processCpuMs() {
  timespec used{};
  if (::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &used) != 0) return 0.0;
  return static_cast<double>(used.tv_sec) * 1e3 + static_cast<double>(used.tv_nsec) * 1e-6;
}

uint64_t peakProcessBytes() {
  rusage usage{};
  if (::getrusage(RUSAGE_SELF, &usage) != 0) return 0;
  constexpr uint64_t kBytesPerUnit = 1024;  // Linux counts in KiB.
  return static_cast<uint64_t>(usage.ru_maxrss) * kBytesPerUnit;
}

}  // namespace lensgraph::engine
