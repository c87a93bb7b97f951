// Nothing is lost when output cannot be written: the old files stay whole, nothing is left beside them, status 1.
#include <sched.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "program.h"

namespace lensgraph {
namespace {

/// As `ulimit -f` in a shell.
bool limitFiles() {
  const rlimit limit{200, 200};
  return setrlimit(RLIMIT_FSIZE, &limit) == 0;
}

/// From here on, what is mounted is seen by this process and its children alone. False where that is not permitted.
bool seesMountsAlone() {
  return unshare(CLONE_NEWNS) == 0 && mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0;
}

/// A full disk on the folder named disk, for this process alone. False where that is not permitted.
bool fillDisk() {
  if (!seesMountsAlone()) return false;
  if (mount("tmpfs", "disk", "tmpfs", 0, "size=16k") != 0) return false;
  std::ofstream("disk/out.exr") << "before";
  std::ofstream filling("disk/filling", std::ios::binary);
  filling << std::string(16384, 'x');
  return true;
}

class Output : public cli_test::ProgramTest {
 protected:
  Output() {
    writeQuad();
    writeShot(shot());
  }
  std::vector<std::string> namesInFolder() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder())) names.push_back(entry.path().filename());
    std::ranges::sort(names);
    return names;
  }
};

TEST_F(Output, AFileSizeLimitKeepsEveryKindOfOldFile) {
  // Of the pictures that are not looked at.
  std::filesystem::create_symlink("/dev/null", folder() / "null.png");
  const std::vector<std::string> render = {"render", "shot.json", "--technique", "pinhole"};
  const auto with = [&](std::initializer_list<std::string> more) {
    auto all = render;
    all.insert(all.end(), more);
    return all;
  };
  const struct {
    std::string file;
    std::vector<std::string> arguments;
  } cases[] = {
      {"old.exr", with({"-o", "old.exr"})},
      {"old.png", with({"-o", "old.png"})},
      {"old.hdr", with({"-o", "old.hdr"})},
      {"depth.exr", with({"-o", "null.png", "--depth-out", "depth.exr"})},
      {"dump.exr", with({"-o", "null.png", "--dump-image", "pinhole.opaque/pinhole.color=dump.exr"})},
      {"capture.json", with({"-o", "null.png", "--capture", "capture.json", "--capture-frames", "1"})},
      {"trace.json", with({"-o", "null.png", "--trace", "trace.json", "--capture-frames", "1"})},
      {"graph.json", {"graph", "shot.json", "--technique", "pinhole", "--json", "graph.json"}},
      {"graph.dot", {"graph", "shot.json", "--technique", "pinhole", "--dot", "graph.dot"}},
  };
  for (const auto& [file, arguments] : cases) {
    SCOPED_TRACE(file);
    write(file, "before");
    const auto before = namesInFolder();
    const auto outcome = run(arguments, limitFiles);
    EXPECT_EQ(outcome.status, 1);
    EXPECT_EQ(outcome.err, "lensgraph: error: " + file + ": writing failed: File too large\n");
    EXPECT_EQ(cli_test::contentOf(folder() / file), "before");
    EXPECT_EQ(namesInFolder(), before);
  }
}

TEST_F(Output, AFullDiskKeepsTheOldPicture) {
  std::filesystem::create_directory(folder() / "disk");
  // The disk is seen by the program alone, so the program looks at it too.
  const auto looksAtDisk = [] {
    if (!fillDisk()) return false;
    const pid_t child = fork();
    if (child == 0) return true;  // becomes the program
    int status = 0;
    waitpid(child, &status, 0);
    std::ostringstream old;
    old << std::ifstream("disk/out.exr").rdbuf();
    const auto names = std::distance(std::filesystem::directory_iterator("disk"), {});
    const bool isWhole = old.str() == "before" && names == 2;
    _exit(!isWhole ? 99 : WIFEXITED(status) ? WEXITSTATUS(status) : 98);
  };
  const auto outcome =
      run({"render", "shot.json", "--technique", "pinhole", "--size", "64x64", "-o", "disk/out.exr"}, looksAtDisk);
  if (outcome.status == 126) GTEST_SKIP() << "no permission to mount a file system";
  EXPECT_EQ(outcome.status, 1) << "99: the old picture was not kept as it was";
  EXPECT_EQ(outcome.err, "lensgraph: error: disk/out.exr: writing failed: No space left on device\n");
}

TEST_F(Output, AReadOnlyFileIsRefused) {
  write("old.exr", "before");
  std::filesystem::permissions(folder() / "old.exr", std::filesystem::perms::owner_read);
  expectError({"render", "shot.json", "-o", "old.exr"}, 2, {"old.exr: --output: cannot be written: it is read-only"});
  EXPECT_EQ(cli_test::contentOf(folder() / "old.exr"), "before");
}

TEST_F(Output, ALinkStaysALink) {
  std::filesystem::create_symlink("real.png", folder() / "link.png");
  runWell({"render", "shot.json", "--technique", "pinhole", "-o", "link.png"});
  EXPECT_TRUE(std::filesystem::is_symlink(folder() / "link.png"));
  EXPECT_TRUE(std::filesystem::is_regular_file(folder() / "real.png"));
}

TEST_F(Output, TwoOutputsThatAreOneFileAreRefused) {
  std::filesystem::create_symlink("a.exr", folder() / "b.exr");
  expectError({"render", "shot.json", "-o", "a.exr", "--depth-out", "b.exr"}, 2, {"is the same file as"});
  write("a.exr", "before");
  expectError({"render", "shot.json", "-o", "a.exr", "--depth-out", "./b.exr"}, 2, {"is the same file as"});
}

/// A file that is a mount point of its own, as container programs make them.
bool mountOnFile() {
  if (!seesMountsAlone()) return false;
  return mount("source.exr", "out.exr", nullptr, MS_BIND, nullptr) == 0;
}

TEST_F(Output, AFileThatIsAMountPointIsWrittenInPlace) {
  write("source.exr", "before");
  write("out.exr", "hidden");
  const auto outcome = run({"render", "shot.json", "--technique", "pinhole", "-o", "out.exr"}, mountOnFile);
  if (outcome.status == 126) GTEST_SKIP() << "no permission to mount a file system";
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(cli_test::contentOf(folder() / "out.exr"), "hidden");
  runWell({"compare", "source.exr", "source.exr"});
}

TEST_F(Output, OneFileForBothFormsOfAGraphIsRefused) {
  expectError({"graph", "shot.json", "--technique", "pinhole", "--dot", "g", "--json", "./g"}, 2,
              {"is the same file as"});
}

TEST_F(Output, ANameThatIsNoUtf8GoesIntoACapture) {
  const std::string name = "quad\xff.gltf";
  std::filesystem::rename(folder() / "quad.gltf", folder() / name);
  std::filesystem::create_symlink(name, folder() / "quad.gltf");
  const std::string shotName = "shot\xff.json";
  std::filesystem::rename(folder() / "shot.json", folder() / shotName);
  runWell(
      {"render", shotName, "--technique", "pinhole", "-o", "a.png", "--capture", "c.json", "--capture-frames", "1"});
  EXPECT_TRUE(nlohmann::json::accept(cli_test::contentOf(folder() / "c.json")));
}

TEST_F(Output, AClosedStandardErrorIsNoFile) {
  const auto closeIt = [] { return close(2) == 0; };
  const auto outcome = run({"render", "shot.json", "--technique", "pinhole", "-o", "a.png"}, closeIt);
  EXPECT_EQ(outcome.status, 0);
  const auto usual = run({"render", "shot.json", "--technique", "pinhole", "-o", "b.png"});
  EXPECT_EQ(cli_test::contentOf(folder() / "a.png"), cli_test::contentOf(folder() / "b.png"));
}

}  // namespace
}  // namespace lensgraph
