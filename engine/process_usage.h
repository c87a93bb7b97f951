// What this process has used of the machine: processor time and memory, as the operating system counts them.
#pragma once

#include <cstdint>

namespace lensgraph::engine {

/// ms of processor time, user and system, that all threads of this process have used since it started. On CPU devices
/// the difference over a frame is the frame's cost: it does not depend on how many cores were free.
double processCpuMs();

/// Bytes: the largest resident memory of this process so far. 0 where the system does not tell.
uint64_t peakProcessBytes();

}  // namespace lensgraph::engine
