// Counts what is asked of the heap through operator new, in the whole program that links allocation_count.cpp.
#pragma once

#include <cstdint>

namespace test_support {

/// On all threads, since the program began.
uint64_t allocationsSoFar();

}  // namespace test_support
