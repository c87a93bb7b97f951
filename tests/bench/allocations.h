// Counts what is asked of the heap through operator new, in this whole program.
#pragma once

#include <cstdint>

namespace bench {

uint64_t allocationsSoFar();

}  // namespace bench
