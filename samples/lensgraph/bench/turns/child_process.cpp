// fork and exec through posix_spawn, waited for with its resource usage: see child_process.h.
#include "samples/lensgraph/bench/turns/child_process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <system_error>

#include "engine/error.h"

extern char** environ;

namespace lensgraph::cli {
namespace {

constexpr int kCannotStart = 127;  // As a shell says it.
constexpr int kSignalled = 128;

std::string contentOf(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream content;
  content << stream.rdbuf();
  return content.str();
}

double milliseconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) * 1e3 + static_cast<double>(time.tv_usec) * 1e-3;
}

int spawn(const std::filesystem::path& program, const std::vector<std::string>& arguments,
          const std::filesystem::path& out, const std::filesystem::path& err, pid_t& child) {
  std::vector<std::string> words = {program.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  constexpr int kFlags = O_WRONLY | O_CREAT | O_TRUNC;
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 1, out.c_str(), kFlags, 0600);
  posix_spawn_file_actions_addopen(&actions, 2, err.c_str(), kFlags, 0600);
  const int error = ::posix_spawn(&child, program.c_str(), &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  return error;
}

}  // namespace

ScratchFolder::ScratchFolder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "lensgraph-XXXXXX").string();
  if (::mkdtemp(pattern.data()) == nullptr) {
    throw engine::Error(pattern + ": cannot be made: " + std::generic_category().message(errno),
                        engine::ErrorKind::failed);
  }
  path_ = pattern;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

ChildOutcome runChild(const std::filesystem::path& program, const std::vector<std::string>& arguments) {
  const ScratchFolder folder;
  const auto out = folder.path() / "output", err = folder.path() / "errors";
  pid_t child = -1;
  ChildOutcome outcome;
  if (const int error = spawn(program, arguments, out, err, child); error != 0) {
    outcome.status = kCannotStart;
    outcome.err = std::generic_category().message(error);
  } else {
    int status = 0;
    rusage usage{};
    while (::wait4(child, &status, 0, &usage) < 0) {
      if (errno == EINTR) continue;
      throw engine::Error(program.string() + ": cannot be waited for", engine::ErrorKind::failed);
    }
    outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : kSignalled + WTERMSIG(status);
    outcome.cpuMs = milliseconds(usage.ru_utime) + milliseconds(usage.ru_stime);
    outcome.out = contentOf(out);
    outcome.err = contentOf(err);
  }
  return outcome;
}

}  // namespace lensgraph::cli
