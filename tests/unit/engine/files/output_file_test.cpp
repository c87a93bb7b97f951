// What is written is whole or absent, whatever goes wrong; what was there before stays until then.
#include "engine/files/output_file.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <future>

#include "engine/error.h"
#include "engine/files/unfinished_files.h"
#include "engine/image/image_io.h"
#include "tests/support/temporary_folder.h"

namespace lensgraph::engine {
namespace {

using test::TemporaryFolder;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::UnorderedElementsAre;

std::string contentOf(const std::filesystem::path& file) {
  const auto bytes = test::readBytes(file);
  return {bytes.begin(), bytes.end()};
}

/// The error that the work throws; fails when there is none.
template <typename Work>
Error errorOf(Work work) {
  try {
    work();
  } catch (const Error& error) {
    return error;
  }
  ADD_FAILURE() << "no error";
  return Error("none");
}

/// No file of this process can grow beyond that size while it lives.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit now{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &now);
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
  }
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_{};
  void (*handler_)(int);
};

TEST(OutputFile, AppearsOnlyWhenItIsPlaced) {
  const TemporaryFolder folder;
  writeFile(folder / "a.txt", "before");
  {
    OutputFile file(folder / "a.txt");
    file.write(std::as_bytes(std::span("after", 5)), 0);
    EXPECT_EQ(contentOf(folder / "a.txt"), "before");
    file.place();
  }
  EXPECT_EQ(contentOf(folder / "a.txt"), "after");
  EXPECT_THAT(folder.names(), ElementsAre("a.txt"));
}

TEST(OutputFile, LeavesNothingWhenItIsNotPlaced) {
  const TemporaryFolder folder;
  writeFile(folder / "a.txt", "before");
  { OutputFile(folder / "a.txt").write(std::as_bytes(std::span("after", 5)), 0); }
  EXPECT_EQ(contentOf(folder / "a.txt"), "before");
  EXPECT_THAT(folder.names(), ElementsAre("a.txt"));
}

TEST(OutputFile, KeepsThePermissionsOfWhatItReplaces) {
  const TemporaryFolder folder;
  writeFile(folder / "a.txt", "before");
  ASSERT_EQ(::chmod((folder / "a.txt").c_str(), 0640), 0);
  writeFile(folder / "a.txt", "after");
  struct stat status {};
  ASSERT_EQ(::stat((folder / "a.txt").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0640u);
}

TEST(OutputFile, FollowsSymbolicLinks) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "deep");
  std::filesystem::create_symlink("deep/real.txt", folder / "second.txt");
  std::filesystem::create_symlink("second.txt", folder / "first.txt");
  for (const char* text : {"made", "replaced"}) {
    writeFile(folder / "first.txt", text);
    EXPECT_EQ(contentOf(folder / "deep/real.txt"), text);
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "first.txt"));
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "second.txt"));
  }
  std::filesystem::create_symlink("circle.txt", folder / "circle.txt");
  EXPECT_THAT(errorOf([&] { writeFile(folder / "circle.txt", "x"); }).what(), HasSubstr("circle of symbolic links"));
}

TEST(OutputFile, WritesStraightToWhatIsNoRegularFile) {
  const TemporaryFolder folder;
  const auto fifo = folder / "fifo.exr";
  ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
  auto reader = std::async(std::launch::async, [&] { return test::readBytes(fifo); });
  FloatImage image(3, 2, 3, 0.5f);
  writeImage(fifo, image);
  test::writeBytes(folder / "copy.exr", reader.get());
  EXPECT_EQ(readImage(folder / "copy.exr").samples, image.samples);
  EXPECT_TRUE(std::filesystem::is_fifo(fifo));
  EXPECT_THAT(folder.names(), UnorderedElementsAre("fifo.exr", "copy.exr"));

  const Error full = errorOf([] { writeFile("/dev/full", "x"); });
  EXPECT_EQ(full.kind(), ErrorKind::failed);
  EXPECT_STREQ(full.what(), "/dev/full: writing failed: No space left on device");
}

TEST(OutputFile, GoesBehindWhatADescriptorHasWritten) {
  const TemporaryFolder folder;
  const int log = ::open((folder / "log").c_str(), O_CREAT | O_WRONLY, 0600);
  ASSERT_EQ(::write(log, "first ", 6), 6);
  const std::filesystem::path link = folder / "link.txt";
  std::filesystem::create_symlink("/proc/self/fd/" + std::to_string(log), link);
  requireWritable(link);
  writeFile(link, "second ");
  ASSERT_EQ(::write(log, "third", 5), 5);
  ::close(log);
  EXPECT_EQ(contentOf(folder / "log"), "first second third");

  int pipe[2];
  ASSERT_EQ(::pipe(pipe), 0);
  writeFile("/dev/fd/" + std::to_string(pipe[1]), "through");
  char read[8] = {};
  EXPECT_EQ(::read(pipe[0], read, sizeof read), 7);
  EXPECT_STREQ(read, "through");
  ::close(pipe[0]);
  ::close(pipe[1]);
}

TEST(OutputFile, RefusesPlacesThatCannotBeWritten) {
  const TemporaryFolder folder;
  writeFile(folder / "readonly.txt", "before");
  ASSERT_EQ(::chmod((folder / "readonly.txt").c_str(), 0444), 0);
  const struct {
    std::filesystem::path file;
    const char* reason;
  } cases[] = {
      {"", "is empty"},
      {folder.path(), "is a folder"},
      {folder / "absent/a.txt", "no such folder"},
      {folder / "readonly.txt/a.txt", "no such folder"},
      {folder / "readonly.txt", "read-only"},
      {folder / std::string(256, 'n'), "File name too long"},
  };
  for (const auto& [file, reason] : cases) {
    for (const bool isProbe : {true, false}) {
      const Error error = errorOf([&, &path = file] { isProbe ? requireWritable(path) : writeFile(path, "x"); });
      EXPECT_EQ(error.kind(), ErrorKind::badInput);
      EXPECT_THAT(error.what(), HasSubstr(reason));
    }
  }
  EXPECT_EQ(contentOf(folder / "readonly.txt"), "before");
  EXPECT_THAT(folder.names(), ElementsAre("readonly.txt"));
}

TEST(OutputFile, NamesAsLongAsTheFileSystemTakesAreWritten) {
  const TemporaryFolder folder;
  const auto file = folder / std::string(255, 'n');
  requireWritable(file);
  writeFile(file, "x");
  EXPECT_EQ(contentOf(file), "x");
}

TEST(OutputFile, AFileSizeLimitLeavesTheOldPictureWhole) {
  const TemporaryFolder folder;
  FloatImage noise(64, 64, 3);
  for (std::size_t i = 0; i < noise.samples.size(); ++i) noise.samples[i] = static_cast<float>(i * 2654435761u % 997);
  for (const char* name : {"a.exr", "a.png", "a.hdr"}) {
    writeFile(folder / name, "before");
    const Error error = [&] {
      const FileSizeLimit limit(100);
      return errorOf([&] { writeImage(folder / name, noise); });
    }();
    EXPECT_EQ(error.kind(), ErrorKind::failed);
    EXPECT_THAT(error.what(), HasSubstr("writing failed: File too large"));
    EXPECT_EQ(contentOf(folder / name), "before");
  }
  EXPECT_THAT(folder.names(), UnorderedElementsAre("a.exr", "a.png", "a.hdr"));
}

TEST(OutputFile, ASignalHandlerCanRemoveWhatIsUnfinished) {
  const TemporaryFolder folder;
  writeFile(folder / "a.txt", "before");
  OutputFile first(folder / "a.txt"), second(folder / "b.txt");
  EXPECT_EQ(folder.names().size(), 3u);
  removeUnfinishedFiles();
  EXPECT_THAT(folder.names(), ElementsAre("a.txt"));
  EXPECT_EQ(errorOf([&] { first.place(); }).kind(), ErrorKind::failed);
  EXPECT_EQ(contentOf(folder / "a.txt"), "before");
}

TEST(OutputFile, MoreFilesThanCanBeNotedAreStillWritten) {
  const TemporaryFolder folder;
  std::vector<std::unique_ptr<OutputFile>> files;
  for (int i = 0; i < 40; ++i) files.push_back(std::make_unique<OutputFile>(folder / std::to_string(i)));
  for (auto& file : files) file->place();
  EXPECT_EQ(folder.names().size(), 40u);
}

}  // namespace
}  // namespace lensgraph::engine
