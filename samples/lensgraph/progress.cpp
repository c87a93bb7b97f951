// The progress bar: see progress.h.
#include "samples/lensgraph/progress.h"

#include <unistd.h>

#include <cstdio>
#include <utility>

namespace lensgraph::cli {
namespace {
constexpr int kBarWidth = 30;
constexpr std::chrono::milliseconds kDrawInterval{100};
}  // namespace

// Short work shows nothing: the first drawing waits for one interval.
ProgressBar::ProgressBar(std::string label)
    : onTerminal_(isatty(STDERR_FILENO) == 1),
      label_(std::move(label)),
      start_(std::chrono::steady_clock::now()),
      nextDraw_(start_ + kDrawInterval) {}

ProgressBar::~ProgressBar() {
  wipe();
}

void ProgressBar::label(std::string text) {
  label_ = std::move(text);
}

void ProgressBar::update(uint32_t done, uint32_t total) {
  const auto now = std::chrono::steady_clock::now();
  if (!onTerminal_ || total == 0 || now < nextDraw_) return;
  nextDraw_ = now + kDrawInterval;
  const double share = static_cast<double>(done) / total;
  const int filled = static_cast<int>(share * kBarWidth);
  const double seconds = std::chrono::duration<double>(now - start_).count();
  std::fprintf(stderr, "\r%s [%.*s%*s] %3.0f %%  %u/%u", label_.c_str(), filled, "##############################",
               kBarWidth - filled, "", share * 100.0, done, total);
  if (done > 0) std::fprintf(stderr, "  %.0f s left", seconds / done * (total - done));
  std::fputs("\033[K", stderr);
  std::fflush(stderr);
  drawn_ = true;
}

void ProgressBar::wipe() {
  if (drawn_) std::fputs("\r\033[K", stderr);
  drawn_ = false;
}

}  // namespace lensgraph::cli
