// Damages files in the ways that files are damaged and attacked: bits, lengths, numbers, cuts, splices.
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace lensgraph::fuzz {

using Bytes = std::vector<uint8_t>;
using Random = std::mt19937_64;

/// A number from 0 to below `count`, which is at least 1. The same on every standard library.
std::size_t pick(Random& random, std::size_t count);

/// One of the seeds with 1 to 8 changes. Mostly, checksums of PNG chunks and lengths of GLB containers are put right
/// again, so that what lies behind them is reached. At most 1 MiB. Precondition: `seeds` is not empty.
Bytes mutated(const std::vector<Bytes>& seeds, Random& random);

}  // namespace lensgraph::fuzz
