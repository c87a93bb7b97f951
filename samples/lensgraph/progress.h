// A progress bar on a terminal; nothing at all in a pipe. Debian has no C++ library for one, and this is all
// it takes.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace lensgraph::cli {

class ProgressBar {
 public:
  explicit ProgressBar(std::string label);
  ~ProgressBar();  ///< Wipes the bar.
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void label(std::string text);
  /// Draws at most ten times a second.
  void update(uint32_t done, uint32_t total);
  void wipe();

 private:
  bool onTerminal_;
  bool drawn_ = false;
  std::string label_;
  std::chrono::steady_clock::time_point start_, nextDraw_;
};

}  // namespace lensgraph::cli
