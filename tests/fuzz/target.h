// What is fuzzed: a reader of bytes with the inputs to start from.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "mutator.h"

namespace lensgraph::fuzz {

struct Target {
  std::string name;
  std::vector<Bytes> seeds;
  /// Reads the bytes as a program does. Throws std::logic_error for what the reader must never do; engine::Error of bad
  /// input is what it may do.
  std::function<void(const Bytes&)> run;
};

/// The target of that name, its files in `folder`, which is empty and its own. Throws std::invalid_argument for an
/// unknown name, with a list of all.
Target makeTarget(const std::string& name, const std::filesystem::path& folder);

}  // namespace lensgraph::fuzz
