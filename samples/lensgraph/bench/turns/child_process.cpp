// posix_spawn with its output in memory, waited for with its resource usage: see child_process.h.
#include "samples/lensgraph/bench/turns/child_process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "engine/error.h"
#include "samples/lensgraph/process.h"

extern char** environ;

namespace lensgraph::cli {
namespace {

constexpr int kCannotStart = 127;  // As a shell says it.
constexpr int kSignalled = 128;

/// A file in memory that a child can write to.
class MemoryFile {
 public:
  explicit MemoryFile(const char* name) : descriptor_(::memfd_create(name, MFD_CLOEXEC)) {
    if (descriptor_ < 0) {
      throw engine::Error("no memory for the output of another program: " + std::generic_category().message(errno),
                          engine::ErrorKind::failed);
    }
  }
  ~MemoryFile() { ::close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  int descriptor() const { return descriptor_; }
  std::string content() const {
    std::string text(static_cast<std::size_t>(::lseek(descriptor_, 0, SEEK_END)), '\0');
    const auto size = ::pread(descriptor_, text.data(), text.size(), 0);
    text.resize(size < 0 ? 0 : static_cast<std::size_t>(size));
    return text;
  }

 private:
  int descriptor_;
};

double milliseconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) * 1e3 + static_cast<double>(time.tv_usec) * 1e-3;
}

int spawn(const std::filesystem::path& program, const std::vector<std::string>& arguments, const MemoryFile& out,
          const MemoryFile& err, pid_t& child) {
  std::vector<std::string> words = {program.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, out.descriptor(), 1);
  posix_spawn_file_actions_adddup2(&actions, err.descriptor(), 2);
  const int error = ::posix_spawn(&child, program.c_str(), &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  return error;
}

}  // namespace

ScratchFolder::ScratchFolder(const std::filesystem::path& folder) : path_(folder / "scratch") {
  std::error_code code;
  std::filesystem::remove_all(path_, code);
  std::filesystem::create_directories(path_, code);
  if (code) throw engine::Error(path_.string() + ": cannot be made: " + code.message(), engine::ErrorKind::failed);
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

ChildOutcome runChild(const std::filesystem::path& program, const std::vector<std::string>& arguments) {
  const MemoryFile out("output"), err("errors");
  pid_t child = -1;
  ChildOutcome outcome;
  if (const int error = spawn(program, arguments, out, err, child); error != 0) {
    outcome.status = kCannotStart;
    outcome.err = std::generic_category().message(error);
    return outcome;
  }
  setChildToEnd(child);
  int status = 0;
  rusage usage{};
  while (::wait4(child, &status, 0, &usage) < 0) {
    if (errno == EINTR) continue;
    throw engine::Error(program.string() + ": cannot be waited for", engine::ErrorKind::failed);
  }
  setChildToEnd(0);
  outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : kSignalled + WTERMSIG(status);
  outcome.cpuMs = milliseconds(usage.ru_utime) + milliseconds(usage.ru_stime);
  outcome.out = out.content();
  outcome.err = err.content();
  return outcome;
}

}  // namespace lensgraph::cli
