// Another build of lensgraph, such as an older commit's, that takes turns with this one in a benchmark.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "samples/host/technique_choice.h"
#include "samples/lensgraph/bench/turns/turn.h"

namespace lensgraph::cli {

/// What one build is asked to render.
struct RenderRequest {
  std::filesystem::path shot;
  int width = 0, height = 0;  ///< px
  const host::TechniqueChoice& choice;
  std::filesystem::path picture;  ///< EXR to write.
  std::string device;             ///< As --device takes it; empty: none given.
};

class OtherProgram {
 public:
  /// "NAME=PATH" of `--program`. Asks the program for its version and for what its `render` can measure. Throws
  /// engine::Error (bad input, field "--program"): no such form, or no lensgraph at that path.
  explicit OtherProgram(const std::string& nameAndPath);

  const std::string& name() const { return name_; }
  const std::string& version() const { return version_; }  ///< "lensgraph 0.1.0"
  const std::string& commit() const { return commit_; }    ///< Empty when it tells none.

  /// Makes the picture. False where it cannot; `reason` then says why in a line.
  bool render(const RenderRequest& request, std::string& reason) const;

  /// Times of a warm frame. A build with `--frames-timed` tells its frame's CPU time itself; of an older one it is the
  /// difference between a process that renders few frames and one that renders more, divided by their number, since
  /// both start up and warm up alike. Nothing where it cannot render this; the reason is then in `reason`.
  /// `scratch` is a folder for its files.
  std::optional<TurnTimes> measure(const RenderRequest& request, const std::filesystem::path& scratch,
                                   std::string& reason) const;

 private:
  std::optional<TurnTimes> timedFrames(const RenderRequest& request, std::string& reason) const;
  std::optional<TurnTimes> framesByDifference(const RenderRequest& request, const std::filesystem::path& scratch,
                                              std::string& reason) const;

  std::string name_, version_, commit_;
  std::filesystem::path path_;
  bool timesFrames_ = false;
};

}  // namespace lensgraph::cli
