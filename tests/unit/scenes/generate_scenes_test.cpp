// The program that writes the scenes says in one line what is wrong with its arguments.
#include <gmock/gmock.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <string>

#include "tests/support/temporary_folder.h"

namespace lensgraph {
namespace {

using testing::HasSubstr;

struct Result {
  int status;
  std::string errors;  ///< Standard error alone.
};

Result generateScenes(const std::string& arguments) {
  std::string command = LENSGRAPH_GENERATE_SCENES " ";
  command.append(arguments).append(" 2>&1 >/dev/null");
  FILE* pipe = ::popen(command.c_str(), "r");
  Result result{-1, {}};
  std::array<char, 512> buffer{};
  while (std::fgets(buffer.data(), static_cast<int>(buffer.size()), pipe) != nullptr) result.errors += buffer.data();
  result.status = WEXITSTATUS(::pclose(pipe));
  return result;
}

void expectUsageError(const std::string& arguments, const std::string& words) {
  const Result result = generateScenes(arguments);
  EXPECT_EQ(result.status, 2) << arguments;
  EXPECT_THAT(result.errors, HasSubstr(words));
  EXPECT_EQ(result.errors.find('\n'), result.errors.size() - 1) << "one line: " << result.errors;
}

TEST(GenerateScenes, BadArgumentsAreOneLineAndExit2) {
  expectUsageError("--heavy", "--heavy needs a value");
  expectUsageError("--heavy ''", "--heavy needs a value");
  expectUsageError("--big out", "'--big' is none of");
  expectUsageError("--heavy a -o b", "more than one place");
  expectUsageError("--heavy a --scaling 1000", "exclude each other");
  expectUsageError("--scaling 1000 -o stones.json", "--scaling needs -o FILE.glb");
  expectUsageError("--scaling 12x -o stones.glb", "'12x' is no number from 1 to 20000000");
}

TEST(GenerateScenes, AFolderThatCannotBeMadeIsOneLineAndExit1) {
  const test::TemporaryFolder folder;
  test::writeBytes(folder / "file", {});
  const Result result = generateScenes("--heavy " + (folder / "file" / "below").string());
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.errors.find('\n'), result.errors.size() - 1) << result.errors;
}

}  // namespace
}  // namespace lensgraph
