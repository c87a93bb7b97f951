// A program that is interrupted while it writes leaves the files as they were.
#include "samples/lensgraph/process.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <csignal>

#include "engine/files/output_file.h"
#include "tests/support/temporary_folder.h"

namespace lensgraph::cli {
namespace {

void beginAndRaise(const std::filesystem::path& file, int signal) {
  setUpProcess();
  engine::OutputFile output(file);
  output.write(std::as_bytes(std::span("half", 4)), 0);
  ::raise(signal);
}

TEST(ProcessDeathTest, AnInterruptedProgramLeavesTheOldFileAndNothingElse) {
  const test::TemporaryFolder folder;
  engine::writeFile(folder / "a.txt", "before");
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    EXPECT_EXIT(beginAndRaise(folder / "a.txt", signal), testing::KilledBySignal(signal), "");
    EXPECT_THAT(folder.names(), testing::ElementsAre("a.txt"));
    EXPECT_EQ(test::readBytes(folder / "a.txt").size(), 6u);
  }
}

TEST(ProcessDeathTest, ASignalThatTheCallerIgnoresStaysIgnored) {
  const auto work = [] {
    std::signal(SIGHUP, SIG_IGN);
    setUpProcess();
    ::raise(SIGHUP);
    ::_exit(7);
  };
  EXPECT_EXIT(work(), testing::ExitedWithCode(7), "");
}

TEST(ProcessDeathTest, NoFileTakesThePlaceOfAClosedStream) {
  const test::TemporaryFolder folder;
  const auto work = [&] {
    ::close(STDERR_FILENO);
    setUpProcess();
    engine::OutputFile output(folder / "a.txt");
    static_cast<void>(::write(STDERR_FILENO, "stray", 5) == 5);
    output.place();
    ::_exit(std::filesystem::file_size(folder / "a.txt") == 0 ? 0 : 1);
  };
  EXPECT_EXIT(work(), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace lensgraph::cli
