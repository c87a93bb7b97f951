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

/// "3/8". Throws engine::Error (field "--shard") for what is no part of a whole.
Shard parseShard(const std::string& text);
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

/// What the case's picture is made from: the shot file, the files of its scene, its environment.
std::vector<std::filesystem::path> filesOf(const host::Shot& shot);

}  // namespace lensgraph::cli
