// What a benchmark measures: shots, sizes, techniques with the parameters to sweep, and how often.
//
// A configuration file, every field but "shots" optional:
//   {
//     "name": "trade",
//     "shots": ["railings.json", {"shot": "glass/shot.json", "reference": "glass/dof.exr"}],
//     "sizes": [[640, 360], [1280, 720]],
//     "variants": [{"technique": "pinhole"},
//                  {"technique": "multiview_synthesis", "parameters": {"lensSamples": [8, 32], "views": 1}}],
//     "repeats": 5, "referenceSamples": 1024, "exposureEv": 0
//   }
// A parameter with an array takes each of its values in turn; several arrays are combined. Files are relative to the
// configuration's folder.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "samples/host/technique_choice.h"

namespace lensgraph::cli {

struct BenchShot {
  std::filesystem::path shot;
  /// A picture to measure against; none: accumulation with BenchConfig::referenceSamples views.
  std::optional<std::filesystem::path> reference;
};

struct BenchSize {
  int width = 0, height = 0;  ///< px
};

/// A technique with some of its parameters set.
struct BenchVariant {
  std::string id;  ///< "multiview_synthesis lensSamples=8": the technique and what was set. Unique.
  host::TechniqueChoice choice;
};

struct BenchConfig {
  std::string name;
  std::vector<BenchShot> shots;        ///< At least one.
  std::vector<BenchSize> sizes;        ///< Empty: each shot's own.
  std::vector<BenchVariant> variants;  ///< At least one.
  int repeats = 5;                     ///< 1…1000 turns of each variant.
  int referenceSamples = 1024;         ///< 256…65536 views of accumulation.
  double exposureEv = 0.0;             ///< Stops by which pictures are brightened before they are compared.
};

/// Fewest samples of a reference: those of the last point of accumulation's curve.
inline constexpr int kLeastReferenceSamples = 256;

/// Reads and checks a file. `shots`, where not empty, replace those of the file, which then needs none. Throws engine::Error
/// that names the file and the field.
BenchConfig readBenchConfig(const std::filesystem::path& file, std::vector<BenchShot> shots = {});

/// The built-in set "quick": every technique with its defaults, three turns. The accumulation reference is no variant of
/// its own; its curve tells what it costs.
BenchConfig quickBench(std::vector<BenchShot> shots);

/// Shots that paths name: a shot file, or a folder with shot files (*.json) or with folders that hold a shot.json. Where
/// a picture called dof.exr lies beside shot.json, it is the reference. Throws engine::Error (field "--shots") where there
/// is nothing.
std::vector<BenchShot> findShots(const std::vector<std::filesystem::path>& paths);

/// What of a configuration must not change between two runs into one folder, or between the parts of a benchmark: fields
/// of texts and numbers. Shots count by their names and by the content of their files and references, wherever they are.
/// Throws engine::Error: a shot that cannot be read.
nlohmann::ordered_json identityOf(const BenchConfig& config);

}  // namespace lensgraph::cli
