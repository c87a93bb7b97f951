// How close packing comes to its bound, and what barrier batches cost in bytes: the same on every machine.
#pragma once

#include <nlohmann/json.hpp>

namespace lensgraph::bench {

/// Heap against the largest live sum, over 200 seeds of 100 passes, by workload and level of aliasing.
nlohmann::ordered_json aliasingQuality();

/// Batches and bytes of wide8 by order and memory budget, over 200 seeds of 100 passes; bytes against the bound of the
/// declared order.
nlohmann::ordered_json batchesAgainstBytes();

/// Every technique with its default parameters at 1280 × 720 and 3840 × 2160 on the nominal device.
nlohmann::ordered_json techniques();

}  // namespace lensgraph::bench
