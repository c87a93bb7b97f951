// A process that is spoken to through pipes, in messages that end with a zero byte.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <string>
#include <vector>

namespace lensgraph::page_test {

class PipeProcess {
 public:
  /// Starts the program with its descriptor 3 as input and 4 as output; what it prints is dropped. `arguments`: with the
  /// program's path as the first. Throws std::runtime_error.
  explicit PipeProcess(const std::vector<std::string>& arguments);
  /// Ends the process and those it started.
  ~PipeProcess();
  PipeProcess(const PipeProcess&) = delete;
  PipeProcess& operator=(const PipeProcess&) = delete;

  void write(std::string message) const;
  /// The next message. Throws std::runtime_error when none comes before the deadline, or the process ended.
  std::string read(std::chrono::steady_clock::time_point deadline);

 private:
  pid_t process_ = -1;
  int input_ = -1, output_ = -1;
  std::string received_;
};

}  // namespace lensgraph::page_test
