// Feeds a target with damaged inputs for some seconds: no crash, no hang, no growth, no exception but refusals.
//
// The target runs in a process of its own, which keeps the input of now where its parent sees it. When it dies or stands
// still, the parent writes that input to a file. Input n of a seed is always the same.
#include <fcntl.h>
#include <spdlog/spdlog.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstring>
#include <exception>
#include <fstream>
#include <iostream>
#include <iterator>
#include <thread>

#include "target.h"

namespace lensgraph::fuzz {
namespace {

using Clock = std::chrono::steady_clock;

#if defined(__SANITIZE_ADDRESS__)
constexpr bool kHasAddressSanitizer = true;
#else
constexpr bool kHasAddressSanitizer = false;
#endif

constexpr std::size_t kMostBytes = std::size_t{1} << 20;
constexpr double kLongestSeconds = kHasAddressSanitizer ? 60.0 : 20.0;  ///< For one input, on a busy machine.
constexpr rlim_t kMostMemory = rlim_t{4} << 30;                         ///< Bytes of address space.
constexpr std::size_t kMostGrowth = std::size_t{kHasAddressSanitizer ? 512 : 96} << 20;  ///< Bytes, resident.

/// What the parent sees of the process with the target.
struct Shared {
  std::atomic<uint64_t> inputs{0};                             ///< Finished.
  std::atomic<std::size_t> residentEarly{0}, residentLate{0};  ///< Bytes, after a quarter of the time and at the end.
  std::size_t size = 0;                                        ///< Of the input of now.
  char reason[512] = {};                                       ///< Of an exception.
  uint8_t bytes[kMostBytes];
};

struct Options {
  std::string target;
  double seconds = 8.0;
  uint64_t seed = 1;
  std::vector<std::string> replayed;
};

std::size_t residentBytes() {
  std::size_t total = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> total >> resident;
  return resident * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

void runOne(const Target& target, const Bytes& input, Shared& shared) {
  shared.size = std::min(input.size(), kMostBytes);
  std::memcpy(shared.bytes, input.data(), shared.size);
  try {
    target.run(input);
  } catch (const std::exception& error) {
    std::snprintf(shared.reason, sizeof shared.reason, "%s", error.what());
    ::_exit(1);
  }
  ++shared.inputs;
}

/// The process with the target; ends the process.
[[noreturn]] void work(const Target& target, const Options& options, Shared& shared) {
  if (!kHasAddressSanitizer) {
    const rlimit limit{kMostMemory, kMostMemory};
    ::setrlimit(RLIMIT_AS, &limit);
  }
  // What readers and programs print is not looked at.
  const int null = ::open("/dev/null", O_WRONLY);
  ::dup2(null, STDOUT_FILENO);
  if (!kHasAddressSanitizer) ::dup2(null, STDERR_FILENO);
  spdlog::set_level(spdlog::level::off);

  const auto start = Clock::now();
  const auto seconds = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
  for (const Bytes& seed : target.seeds) runOne(target, seed, shared);
  for (uint64_t i = 0; options.replayed.empty() && seconds() < options.seconds; ++i) {
    Random random(options.seed + i * 0x9e3779b97f4a7c15u);
    runOne(target, mutated(target.seeds, random), shared);
    if (shared.residentEarly == 0 && seconds() > options.seconds / 4) shared.residentEarly = residentBytes();
  }
  shared.residentLate = residentBytes();
  ::_exit(0);
}

/// Waits for the process; says what went wrong, or nothing.
std::string watch(pid_t child, const Shared& shared) {
  uint64_t inputs = 0;
  auto changed = Clock::now();
  for (;;) {
    int status = 0;
    if (::waitpid(child, &status, WNOHANG) == child) {
      if (WIFSIGNALED(status)) return std::string("died of ") + ::strsignal(WTERMSIG(status));
      if (WEXITSTATUS(status) == 0) return "";
      return shared.reason[0] != '\0' ? shared.reason : "ended with status " + std::to_string(WEXITSTATUS(status));
    }
    if (shared.inputs != inputs) {
      inputs = shared.inputs;
      changed = Clock::now();
    }
    if (std::chrono::duration<double>(Clock::now() - changed).count() > kLongestSeconds) {
      ::kill(child, SIGKILL);
      ::waitpid(child, &status, 0);
      return "an input took longer than " + std::to_string(static_cast<int>(kLongestSeconds)) + " s";
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

/// The target, with the files that are to be replayed as its only seeds.
Target targetOf(const Options& options, const std::filesystem::path& folder) {
  Target target = makeTarget(options.target, folder);
  if (options.replayed.empty()) return target;
  target.seeds.clear();
  for (const auto& file : options.replayed) {
    std::ifstream stream(file, std::ios::binary);
    target.seeds.emplace_back(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
  }
  return target;
}

int run(const Options& options) {
  std::string folder = (std::filesystem::temp_directory_path() / "lensgraph-fuzz-XXXXXX").string();
  if (::mkdtemp(folder.data()) == nullptr) throw std::runtime_error("no temporary folder");
  const struct Remover {
    std::filesystem::path folder;
    ~Remover() {
      std::error_code ignored;
      std::filesystem::remove_all(folder, ignored);
    }
  } remover{folder};

  void* memory = ::mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::runtime_error("no shared memory");
  Shared& shared = *new (memory) Shared;

  const pid_t child = ::fork();
  if (child < 0) throw std::runtime_error("no process for the target");
  if (child == 0) {
    // Made here, not before: the libraries' threads do not live on in a forked process.
    try {
      work(targetOf(options, folder), options, shared);
    } catch (const std::exception& error) {
      std::snprintf(shared.reason, sizeof shared.reason, "%s", error.what());
      ::_exit(2);
    }
  }
  const std::string problem = watch(child, shared);
  const uint64_t inputs = shared.inputs;
  if (!problem.empty()) {
    const std::string file = "fuzz-" + options.target + "-" + std::to_string(inputs) + ".input";
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(shared.bytes), static_cast<std::streamsize>(shared.size));
    std::cerr << options.target << ": after " << inputs << " inputs of seed " << options.seed << ": " << problem
              << "\nkept as " << file << "; again with --replay " << file << "\n";
    return 1;
  }
  const std::size_t early = shared.residentEarly, late = shared.residentLate;
  std::cout << options.target << ": " << inputs << " inputs, seed " << options.seed << ", resident memory "
            << (early >> 20) << " MB after a quarter of the time, " << (late >> 20) << " MB at the end\n";
  if (early != 0 && late > early + kMostGrowth) {
    std::cerr << options.target << ": memory grows\n";
    return 1;
  }
  return 0;
}

}  // namespace
}  // namespace lensgraph::fuzz

int main(int argc, char** argv) {
  lensgraph::fuzz::Options options;
  CLI::App app("Feeds readers with damaged inputs.");
  app.add_option("target", options.target, "shot, gltf, picture or command_line")->required();
  app.add_option("--seconds", options.seconds, "How long")->capture_default_str();
  app.add_option("--seed", options.seed, "Of the random numbers")->capture_default_str();
  app.add_option("--replay", options.replayed, "Files to be given to the target once, and nothing else");
  CLI11_PARSE(app, argc, argv);
  try {
    return lensgraph::fuzz::run(options);
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 2;
  }
}
