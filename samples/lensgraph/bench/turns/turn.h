// One turn of a variant: its frames' times, and how many frames make a turn.
#pragma once

#include <algorithm>

namespace lensgraph::cli {

/// Of one frame, ms; the mean where a turn has several.
struct TurnTimes {
  double cpuMs = 0.0;  ///< User and system time of all threads.
  double wallMs = 0.0, gpuMs = 0.0;
};

inline constexpr int kMostFramesOfTurn = 20;

/// Frames of a turn: enough that clocks and other processes matter little, and one alone when that takes long.
inline int framesOfTurn(double frameWallMs) {
  constexpr double kTurnMs = 60.0;
  return static_cast<int>(std::clamp(kTurnMs / std::max(frameWallMs, 1e-3), 1.0, double{kMostFramesOfTurn}));
}

/// The mean of the frames of a turn.
class TurnMean {
 public:
  void add(const TurnTimes& frame) {
    sum_.cpuMs += frame.cpuMs;
    sum_.wallMs += frame.wallMs;
    sum_.gpuMs += frame.gpuMs;
    ++count_;
  }
  /// Precondition: a frame was added.
  TurnTimes result() const { return {sum_.cpuMs / count_, sum_.wallMs / count_, sum_.gpuMs / count_}; }

 private:
  TurnTimes sum_;
  int count_ = 0;
};

}  // namespace lensgraph::cli
