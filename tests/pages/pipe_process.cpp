// Pipes to a process: see pipe_process.h.
#include "pipe_process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <stdexcept>

namespace lensgraph::page_test {
namespace {

/// In the new process: descriptors 3 and 4, a process group of its own, and the program.
[[noreturn]] void becomeProgram(std::vector<char*>& argv, int input, int output) {
  setpgid(0, 0);
  // Out of the way of 3 and 4 first, then onto them, which clears close-on-exec.
  input = fcntl(input, F_DUPFD, 10);
  output = fcntl(output, F_DUPFD, 10);
  const int nothing = open("/dev/null", O_RDWR);
  dup2(nothing, 0);
  dup2(nothing, 1);
  dup2(nothing, 2);
  dup2(input, 3);
  dup2(output, 4);
  execv(argv[0], argv.data());
  _exit(127);
}

}  // namespace

PipeProcess::PipeProcess(const std::vector<std::string>& arguments) {
  std::signal(SIGPIPE, SIG_IGN);  // A process that ended is an error of write().
  std::array<int, 2> in{}, out{};
  if (pipe2(in.data(), O_CLOEXEC) != 0 || pipe2(out.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipes");
  std::vector<char*> argv;
  for (const auto& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  process_ = fork();
  if (process_ == 0) becomeProgram(argv, in[0], out[1]);
  close(in[0]);
  close(out[1]);
  input_ = in[1];
  output_ = out[0];
  if (process_ < 0) throw std::runtime_error("no new process");
}

PipeProcess::~PipeProcess() {
  close(input_);
  close(output_);
  if (process_ > 0) {
    kill(-process_, SIGKILL);
    waitpid(process_, nullptr, 0);
  }
}

void PipeProcess::write(std::string message) const {
  message += '\0';
  for (std::size_t done = 0; done < message.size();) {
    const ssize_t count = ::write(input_, message.data() + done, message.size() - done);
    if (count <= 0) throw std::runtime_error("the browser takes no more messages");
    done += static_cast<std::size_t>(count);
  }
}

std::string PipeProcess::read(std::chrono::steady_clock::time_point deadline) {
  for (std::size_t searched = 0;;) {
    if (const auto end = received_.find('\0', searched); end != std::string::npos) {
      const std::string message = received_.substr(0, end);
      received_.erase(0, end + 1);
      return message;
    }
    searched = received_.size();
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now()).count();
    pollfd waited{.fd = output_, .events = POLLIN, .revents = 0};
    if (left <= 0 || poll(&waited, 1, static_cast<int>(left)) == 0) throw std::runtime_error("the browser is silent");
    std::array<char, 65536> buffer;
    const ssize_t count = ::read(output_, buffer.data(), buffer.size());
    if (count <= 0) throw std::runtime_error("the browser ended");
    received_.append(buffer.data(), static_cast<std::size_t>(count));
  }
}

}  // namespace lensgraph::page_test
