// One shot in one size, ready to be measured, and which parts of a benchmark a shard of it takes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "samples/host/shot.h"
#include "samples/lensgraph/bench/bench_config.h"

namespace lensgraph::cli {

/// Part `index` of `count`; the whole benchmark is part 1 of 1.
struct Shard {
  int index = 1, count = 1;
};

/// Of a text such as "3/8"; none for what is no part of a whole.
std::optional<Shard> shardFrom(const std::string& text);
std::string nameOf(const Shard& shard);

struct BenchCase {
  std::string id;      ///< "railings_640x360"
  std::string shotId;  ///< "railings"
  host::Shot shot;     ///< In the case's size.
  std::optional<std::filesystem::path> reference;
  std::vector<BenchVariant> variants;  ///< Those of the shard.
};

/// All cases of which the shard has variants. Pairs of case and variant are dealt out in contiguous runs, so that a shard
/// needs few references. Throws engine::Error: a shot that cannot be read, a reference of another size.
std::vector<BenchCase> casesOf(const BenchConfig& config, const Shard& shard);

}  // namespace lensgraph::cli
