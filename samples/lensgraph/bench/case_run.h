// One case of a benchmark being measured: reference, pictures, turns.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "engine/vulkan/device.h"
#include "samples/host/renderer.h"
#include "samples/lensgraph/bench/bench_case.h"
#include "samples/lensgraph/bench/bench_config.h"
#include "samples/lensgraph/bench/case_reference.h"
#include "samples/lensgraph/bench/journal.h"
#include "samples/lensgraph/bench/turns/other_program.h"
#include "samples/lensgraph/bench/turns/screen_copy.h"
#include "samples/lensgraph/bench/turns/turn.h"

namespace lensgraph::cli {

struct BenchRunOptions {
  std::filesystem::path folder;      ///< Pictures go to folder/pictures.
  std::filesystem::path references;  ///< Folder of accumulation_pictures.h.
  std::string device;                ///< As --device takes it, for other programs; empty: none given.
};

/// Whose turn it is.
struct PlannedTurn {
  std::string program;
  const BenchVariant* variant = nullptr;  ///< Null for units.
  std::string name;                       ///< Variant's id, or the unit's.
};

/// The scene is on the device from run() on as long as this lives; everything given to the constructor outlives it.
class CaseRun {
 public:
  CaseRun(engine::Device& device, const BenchConfig& config, const BenchCase& benchCase,
          std::vector<OtherProgram>& programs, const BenchRunOptions& options, Journal& journal);

  /// What is left to be measured, in turns.
  double remaining() const;

  /// Measures what the journal does not hold yet, told to `progress` in turns. Throws what rendering throws; the journal
  /// then holds what was measured before.
  void run(const std::function<void(double done, const std::string& what)>& progress);

 private:
  void load();
  void measureReference(const std::function<void(double)>& progress);
  void measureVariant(const PlannedTurn& turn);
  nlohmann::ordered_json variantOfThis(const PlannedTurn& turn, const std::filesystem::path& picture);
  nlohmann::ordered_json variantOfOther(const PlannedTurn& turn, const std::filesystem::path& picture);
  void takeTurn(const PlannedTurn& turn, int round);
  std::optional<TurnTimes> timesOf(const PlannedTurn& turn);
  TurnTimes timesOfFrames(const std::string& technique, const passes::ParameterSet& parameters);
  OtherProgram& programOf(const PlannedTurn& turn);
  bool isUnavailable(const PlannedTurn& turn) const;
  std::filesystem::path pictureOf(const PlannedTurn& turn) const;

  engine::Device& device_;
  const BenchConfig& config_;
  const BenchCase& case_;
  std::vector<OtherProgram>& programs_;
  const BenchRunOptions& options_;
  Journal& journal_;
  std::vector<PlannedTurn> turns_;
  uint64_t triangles_ = 0;
  std::unique_ptr<host::Renderer> renderer_;
  std::unique_ptr<ScreenCopy> copy_;
  std::unique_ptr<CaseReference> reference_;
};

}  // namespace lensgraph::cli
