// Reads what `lensgraph bench` wrote.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

namespace lensgraph::cli {

/// The bench.json of a folder, or the file itself. Checked as far as programs that read it rely on it: every field of
/// bench_document.h is there and of its type. Throws engine::Error that names the file and the field.
nlohmann::ordered_json readBenchFile(const std::filesystem::path& fileOrFolder);

}  // namespace lensgraph::cli
