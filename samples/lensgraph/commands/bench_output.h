// The files in which the results of a benchmark end, as `bench` and `bench-merge` write them.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

namespace lensgraph::cli {

/// Writes bench.json, bench.csv and, where the program can make pages, index.html into the folder, and prints the table
/// and where they are. The pictures that the document names are in the folder.
void writeBench(const nlohmann::ordered_json& document, const std::filesystem::path& folder);

}  // namespace lensgraph::cli
