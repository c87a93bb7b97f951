// Files that appear whole or not at all: written beside their place, checked to the last byte, then renamed.
//
// Whatever goes wrong in between (a full disk, a file size limit, an exception), the file that was there before stays
// as it was, and nothing is left beside it. Where a signal ends the process, removeUnfinishedFiles()
// in unfinished_files.h does the same.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lensgraph::engine {

/// Throws Error unless an OutputFile could be made there; leaves nothing behind. `field` is the option or parameter
/// that names the file, for the message; may be empty. Bad input: an empty path, a folder, a file without permission
/// to write (a file whose mode lets nobody write is refused even to the superuser), a folder that is missing or takes
/// no files, a name that is too long. Failed: a full disk, no file descriptors left.
void requireWritable(const std::filesystem::path& destination, const std::string& field = {});

/// The file that an OutputFile at this path writes: symbolic links followed, even where they lead to nothing yet, and the
/// folder made canonical as far as it exists. Empty for an empty path. Throws Error for a circle of links.
std::filesystem::path writtenPath(const std::filesystem::path& destination);

/// One file being written. Symbolic links are followed: what they point to is replaced, the link stays. A file that
/// is replaced hands on its permissions. What is no regular file (a FIFO, a device) or a descriptor of this process
/// (/dev/stdout) is kept in memory and written straight by place(). What can be written and not replaced, such as a file
/// that is a mount point, is overwritten in place with the whole content.
class OutputFile {
 public:
  /// Opens the temporary file. Throws as requireWritable().
  explicit OutputFile(const std::filesystem::path& destination);
  /// Removes the temporary file unless place() succeeded.
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Writes bytes at an offset from the start; places between that were never written are zeros. Throws Error (failed).
  void write(std::span<const std::byte> bytes, uint64_t offset);
  uint64_t size() const { return size_; }

  /// Flushes to the device, closes and renames, each checked. To be called once, last. Throws Error (failed).
  void place();

 private:
  [[noreturn]] void fail(int error) const;
  void placeStraight();
  void copyIntoTarget();

  std::filesystem::path destination_;  ///< As the user gave it, for messages.
  std::filesystem::path target_;       ///< Behind symbolic links.
  std::filesystem::path temporary_;    ///< Empty when the target is no regular file.
  int slot_ = -1;                      ///< Of the temporary file among the unfinished ones.
  int descriptor_ = -1;
  uint64_t size_ = 0;
  std::vector<std::byte> straight_;  ///< Content for a target that is no regular file.
};

/// An OutputFile with that content. Throws as OutputFile does.
void writeFile(const std::filesystem::path& destination, std::string_view content);

}  // namespace lensgraph::engine
