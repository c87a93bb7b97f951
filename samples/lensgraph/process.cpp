// Signals and standard streams: see process.h.
#include "samples/lensgraph/process.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <csignal>

#include "engine/files/unfinished_files.h"

namespace lensgraph::cli {
namespace {

std::atomic<int> childToEnd = 0;

void endBySignal(int signal) {
  engine::removeUnfinishedFiles();
  if (const int child = childToEnd.load(); child > 0) ::kill(child, SIGTERM);
  // Blocked while its handler runs, it ends the process as soon as this returns.
  std::signal(signal, SIG_DFL);
  ::raise(signal);
}

void handle(int signal) {
  struct sigaction before {};
  if (::sigaction(signal, nullptr, &before) != 0 || before.sa_handler == SIG_IGN) return;
  struct sigaction action {};
  action.sa_handler = endBySignal;
  ::sigaction(signal, &action, nullptr);
}

}  // namespace

void setChildToEnd(int process) {
  childToEnd.store(process);
}

void setUpProcess() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    // The lowest free number is taken, which is this one. Open for the wrong direction, so that a use fails as before.
    if (::fcntl(stream, F_GETFD) < 0) ::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
  }
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE, SIGALRM}) handle(signal);
  std::signal(SIGXFSZ, SIG_IGN);
}

}  // namespace lensgraph::cli
