// What is measured of a case, in which order, and how: see case_run.h.
#include "samples/lensgraph/bench/case_run.h"

#include <spdlog/spdlog.h>

#include <memory>
#include <optional>
#include <stdexcept>

#include "engine/error.h"
#include "engine/image/image_io.h"
#include "samples/host/measures/shot_files.h"
#include "samples/host/renderer.h"
#include "samples/host/shot_scene.h"
#include "samples/lensgraph/bench/accumulation_pictures.h"
#include "samples/lensgraph/bench/case_reference.h"
#include "samples/lensgraph/bench/names.h"
#include "samples/lensgraph/bench/turns/child_process.h"
#include "samples/lensgraph/bench/turns/screen_copy.h"
#include "samples/lensgraph/bench/turns/turn.h"
#include "samples/lensgraph/bench/units.h"
#include "samples/lensgraph/capture/capture_file.h"
#include "samples/lensgraph/version.h"

namespace lensgraph::cli {
namespace {

using nlohmann::ordered_json;

constexpr const char* kThisProgram = "this";

/// What remains to be done, in turns: a reference counts as the many views that it has.
constexpr double kReferenceTurns = 24.0;

std::string caseKey(const BenchCase& each) {
  return "case|" + each.id;
}
std::string variantKey(const BenchCase& each, const PlannedTurn& turn) {
  return "variant|" + each.id + "|" + turn.program + "|" + turn.name;
}
std::string turnKey(const BenchCase& each, const PlannedTurn& turn, int round) {
  return "turn|" + each.id + "|" + turn.program + "|" + turn.name + "|" + std::to_string(round);
}

}  // namespace

CaseRun::CaseRun(engine::Device& device, const BenchConfig& config, const BenchCase& benchCase,
                 std::vector<OtherProgram>& programs, const BenchRunOptions& options, Journal& journal)
    : device_(device), config_(config), case_(benchCase), programs_(programs), options_(options), journal_(journal) {
  for (const char* unit : {kPinholeUnit, kCopyUnit, kViewUnit}) turns_.push_back({kThisProgram, nullptr, unit});
  for (const BenchVariant& variant : case_.variants) {
    turns_.push_back({kThisProgram, &variant, variant.id});
    for (const auto& program : programs_) turns_.push_back({program.name(), &variant, variant.id});
  }
}

double CaseRun::remaining() const {
  double count = journal_.find(caseKey(case_)) == nullptr ? kReferenceTurns : 0.0;
  for (const auto& turn : turns_) {
    if (turn.variant != nullptr && journal_.find(variantKey(case_, turn)) == nullptr) ++count;
    for (int round = 0; round < config_.repeats; ++round) {
      if (journal_.find(turnKey(case_, turn, round)) == nullptr) ++count;
    }
  }
  return count;
}

void CaseRun::load() {
  std::vector<std::string> warnings;
  auto scene = host::loadShotScene(case_.shot, warnings);
  triangles_ = engine::triangleCount(scene);
  renderer_ = std::make_unique<host::Renderer>(device_, std::move(scene), host::loadShotEnvironment(case_.shot));
  copy_ = std::make_unique<ScreenCopy>(device_, static_cast<uint32_t>(case_.shot.width),
                                       static_cast<uint32_t>(case_.shot.height));
  for (const auto& warning : warnings) spdlog::warn("{}: {}", case_.id, warning);
}

void CaseRun::run(const std::function<void(double, const std::string&)>& progress) {
  const double all = remaining();
  if (all == 0.0) return;
  progress(0.0, case_.id);
  load();
  measureReference([&](double share) { progress(share * kReferenceTurns, case_.id + " reference"); });
  const auto done = [&](const PlannedTurn& turn) {
    progress(all - remaining(), case_.id + " " + (turn.program == kThisProgram ? "" : turn.program + " ") + turn.name);
  };
  for (const auto& turn : turns_) {
    if (turn.variant == nullptr || journal_.find(variantKey(case_, turn)) != nullptr) continue;
    measureVariant(turn);
    done(turn);
  }
  for (int round = 0; round < config_.repeats; ++round) {
    for (const auto& turn : turns_) {
      if (journal_.find(turnKey(case_, turn, round)) != nullptr) continue;
      takeTurn(turn, round);
      done(turn);
    }
  }
}

void CaseRun::measureReference(const std::function<void(double)>& progress) {
  const int samples = case_.reference ? kLastCurveSamples : config_.referenceSamples;
  const auto& device = device_.description();
  const auto pictures = accumulationPictures(*renderer_, case_.shot, samples, case_.id, device.name + device.driver,
                                             options_.references, progress);
  if (pictures.commit != kCommit) {
    spdlog::warn("{}: the reference in {} was rendered by commit {}", case_.id, options_.references.string(),
                 pictures.commit);
  }
  const auto& picture = case_.reference ? engine::readImage(*case_.reference) : pictures.reference;
  reference_ = std::make_unique<CaseReference>(*renderer_, case_.shot, picture, config_.exposureEv);
  if (journal_.find(caseKey(case_)) != nullptr) return;

  const std::string file = "pictures/" + case_.id + "/reference.exr";
  std::filesystem::create_directories((options_.folder / file).parent_path());
  engine::writeImage(options_.folder / file, reference_->picture());
  ordered_json maskPictures = ordered_json::object();
  for (const auto& mask : reference_->masks()) {
    const std::string maskFile = "pictures/" + case_.id + "/mask_" + std::string(mask.name) + ".png";
    engine::writeImage(options_.folder / maskFile, mask.pixels);
    maskPictures[std::string(mask.name)] = maskFile;
  }
  ordered_json curve = ordered_json::array();
  for (const auto& point : pictures.curve) {
    ordered_json quality = reference_->curveQuality(point.picture);
    ordered_json entry = {{"samples", point.samples}};
    entry.update(quality);
    curve.push_back(std::move(entry));
  }
  const auto& shot = case_.shot;
  journal_.add(caseKey(case_), {{"id", case_.id},
                                {"shot", case_.shotId},
                                {"name", shot.name},
                                {"file", shot.file.filename().string()},
                                {"sceneHash", host::hashOfFiles(host::filesOf(shot))},
                                {"triangles", triangles_},
                                {"width", shot.width},
                                {"height", shot.height},
                                {"reference",
                                 {{"kind", case_.reference ? "file" : "accumulation"},
                                  {"samples", case_.reference ? ordered_json() : ordered_json(samples)},
                                  {"commit", pictures.commit},
                                  {"picture", file}}},
                                {"masks", reference_->maskShares()},
                                {"maskPictures", std::move(maskPictures)},
                                {"accumulation", std::move(curve)}});
}

std::filesystem::path CaseRun::pictureOf(const PlannedTurn& turn) const {
  const std::string prefix = turn.program == kThisProgram ? "" : turn.program + " ";
  return std::filesystem::path("pictures") / case_.id / (fileNameOf(prefix + turn.name) + ".exr");
}

OtherProgram& CaseRun::programOf(const PlannedTurn& turn) {
  for (auto& program : programs_) {
    if (program.name() == turn.program) return program;
  }
  throw std::logic_error("no program called " + turn.program);
}

bool CaseRun::isUnavailable(const PlannedTurn& turn) const {
  if (turn.variant == nullptr) return false;
  const auto* record = journal_.find(variantKey(case_, turn));
  return record != nullptr && record->contains("unavailable");
}

void CaseRun::measureVariant(const PlannedTurn& turn) {
  const auto picture = pictureOf(turn);
  auto record = turn.program == kThisProgram ? variantOfThis(turn, picture) : variantOfOther(turn, picture);
  const auto& choice = turn.variant->choice;
  ordered_json changed = ordered_json::object();
  for (const auto& [name, value] : choice.parameters) changed[name] = toJson(value);
  ordered_json line = {{"case", case_.id},
                       {"id", turn.name},
                       {"program", turn.program},
                       {"technique", choice.name},
                       {"parameters", allParameters(choice)},
                       {"changed", std::move(changed)}};
  line.update(record);
  journal_.add(variantKey(case_, turn), std::move(line));
}

ordered_json CaseRun::variantOfThis(const PlannedTurn& turn, const std::filesystem::path& picture) {
  host::RenderOptions options;
  options.technique = turn.variant->choice.name;
  options.parameters = turn.variant->choice.parameters;
  options.execute.timing = rendergraph::Timing::isolated;  // Right on every device, pass by pass.
  const auto rendering = renderer_->render(case_.shot, options);
  for (const auto& warning : rendering.warnings) spdlog::warn("{} {}: {}", case_.id, turn.name, warning);
  engine::writeImage(options_.folder / picture, rendering.color);
  ordered_json passes = ordered_json::array();
  for (const auto& pass : rendering.capture.passes) {
    if (pass.gpuMs >= 0.0) passes.push_back({{"name", pass.name}, {"ms", pass.gpuMs}});
  }
  return {{"quality", reference_->quality(rendering.color)},
          {"memory", {{"graphBytes", rendering.graphBytes}}},
          {"executions", rendering.executions},
          {"warnings", rendering.warnings},
          {"picture", picture.string()},
          {"passes", std::move(passes)}};
}

ordered_json CaseRun::variantOfOther(const PlannedTurn& turn, const std::filesystem::path& picture) {
  std::string reason;
  const RenderRequest request{case_.shot.file,      case_.shot.width,          case_.shot.height,
                              turn.variant->choice, options_.folder / picture, options_.device};
  if (!programOf(turn).render(request, reason)) {
    spdlog::warn("{} {}: {} cannot render it: {}", case_.id, turn.name, turn.program, reason);
    return {{"unavailable", reason}};
  }
  try {
    return {{"quality", reference_->quality(engine::readImage(options_.folder / picture))},
            {"picture", picture.string()}};
  } catch (const engine::Error& error) {
    spdlog::warn("{} {}: the picture of {} cannot be compared: {}", case_.id, turn.name, turn.program, error.what());
    return {{"unavailable", error.what()}};
  }
}

void CaseRun::takeTurn(const PlannedTurn& turn, int round) {
  ordered_json record = {{"case", case_.id}, {"id", turn.name}, {"program", turn.program}, {"round", round}};
  if (!isUnavailable(turn)) {
    if (const auto times = timesOf(turn)) {
      record.update({{"cpuMs", times->cpuMs}, {"wallMs", times->wallMs}, {"gpuMs", times->gpuMs}});
    }
  }
  journal_.add(turnKey(case_, turn, round), std::move(record));
}

std::optional<TurnTimes> CaseRun::timesOf(const PlannedTurn& turn) {
  if (turn.name == kPinholeUnit) return timesOfFrames("pinhole", {});
  if (turn.name == kViewUnit) {
    const TurnTimes times = timesOfFrames("accumulation", {{"lensSamples", int64_t{kUnitViews}}});
    return TurnTimes{times.cpuMs / kUnitViews, times.wallMs / kUnitViews, times.gpuMs / kUnitViews};
  }
  if (turn.name == kCopyUnit) {
    copy_->copy();
    TurnMean mean;
    for (int frame = 0; frame < kMostFramesOfTurn; ++frame) mean.add(copy_->copy());
    return mean.result();
  }
  if (turn.program == kThisProgram) return timesOfFrames(turn.variant->choice.name, turn.variant->choice.parameters);
  std::string reason;
  const ScratchFolder scratch(options_.folder);
  const auto picture = scratch.path() / "turn.exr";
  const RenderRequest request{case_.shot.file,      case_.shot.width, case_.shot.height,
                              turn.variant->choice, picture,          options_.device};
  const auto times = programOf(turn).measure(request, scratch.path(), reason);
  if (!times) spdlog::warn("{} {}: {} could not be timed: {}", case_.id, turn.name, turn.program, reason);
  return times;
}

TurnTimes CaseRun::timesOfFrames(const std::string& technique, const passes::ParameterSet& parameters) {
  host::RenderOptions options;
  options.technique = technique;
  options.parameters = parameters;
  options.execute.timing = rendergraph::Timing::inlineTimestamps;
  // Another technique had the turn before: this frame makes the plan and the memory again. Where there is no plan
  // (raytraced), it counts.
  const auto first = renderer_->render(case_.shot, options);
  if (first.executions == 0) return {first.cpuMs, first.wallMs, first.gpuMs};
  const int frames = framesOfTurn(first.wallMs);
  TurnMean mean;
  for (int frame = 0; frame < frames; ++frame) {
    const auto rendering = renderer_->render(case_.shot, options);
    mean.add({rendering.cpuMs, rendering.wallMs, rendering.gpuMs});
  }
  return mean.result();
}

}  // namespace lensgraph::cli
