// Files that appear whole or not at all: see output_file.h.
#include "engine/files/output_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <system_error>

#include "engine/error.h"
#include "engine/files/unfinished_files.h"

namespace lensgraph::engine {
namespace {

namespace fs = std::filesystem;

/// Whether the place is good and only the machine has no room for it now.
ErrorKind kindOf(int error) {
  const bool isShortage = error == ENOSPC || error == EDQUOT || error == EMFILE || error == ENFILE || error == ENOMEM ||
                          error == EIO || error == EFBIG;
  return isShortage ? ErrorKind::failed : ErrorKind::badInput;
}

[[noreturn]] void refuse(const fs::path& file, const std::string& field, const std::string& reason,
                         const std::string& remedy, ErrorKind kind = ErrorKind::badInput) {
  throw Error({.file = file.string(), .field = field, .reason = reason, .remedy = remedy}, kind);
}

/// The descriptor of this process that a path such as /proc/self/fd/1 stands for, where /dev/stdout leads; -1 for others.
/// The text of such a link is no path to follow: a pipe has none, and a file must be written where the descriptor stands
/// in it, behind what others have written.
int descriptorOf(const fs::path& path) {
  std::error_code error;
  const fs::path folder = fs::canonical(path.has_parent_path() ? path.parent_path() : fs::path("."), error);
  if (error || folder != fs::path("/proc") / std::to_string(::getpid()) / "fd") return -1;
  const std::string name = path.filename().string();
  int number = -1;
  const auto [end, code] = std::from_chars(name.data(), name.data() + name.size(), number);
  return code == std::errc{} && end == name.data() + name.size() ? number : -1;
}

/// What a path finally names; its last part need not exist.
fs::path behindLinks(const fs::path& path, const std::string& field) {
  constexpr int kMostLinks = 40;  // As many as Linux follows.
  fs::path target = path;
  for (int i = 0; i < kMostLinks; ++i) {
    std::error_code error;
    if (descriptorOf(target) >= 0 || !fs::is_symlink(fs::symlink_status(target, error))) return target;
    const fs::path next = fs::read_symlink(target, error);
    if (error) return target;
    target = next.is_absolute() ? next : target.parent_path() / next;
  }
  refuse(path, field, "is a circle of symbolic links", "choose another file");
}

fs::path folderOf(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

/// A name beside the target, hidden and unique to this process. Short whatever the target's name is.
fs::path temporaryBeside(const fs::path& target) {
  static std::atomic<unsigned> counter{0};
  return folderOf(target) / (".lensgraph-" + std::to_string(::getpid()) + "-" + std::to_string(counter++) + ".tmp");
}

/// A place that can be written, found out without changing it.
struct Place {
  fs::path target;        ///< Behind symbolic links.
  bool isStraight;        ///< No regular file: written straight.
  mode_t mode;            ///< For the new file, before umask where it replaces none.
  bool replaces = false;  ///< A file is there.
};

Place requirePlace(const fs::path& destination, const std::string& field) {
  if (destination.empty()) refuse(destination, field, "is empty", "name a file");
  Place place{.target = behindLinks(destination, field), .isStraight = false, .mode = 0666};
  struct stat status {};
  if (::stat(place.target.c_str(), &status) != 0) {
    if (errno != ENOENT && errno != ENOTDIR) {
      refuse(destination, field, std::string("cannot be written: ") + std::strerror(errno), "choose another place",
             kindOf(errno));
    }
    std::error_code code;
    const fs::path folder = folderOf(place.target);
    if (!fs::is_directory(folder, code)) {
      refuse(destination, field, "cannot be written: no such folder: " + folder.string(), "make the folder first");
    }
    return place;
  }
  if (S_ISDIR(status.st_mode)) refuse(destination, field, "is a folder", "name a file in it");
  place.isStraight = !S_ISREG(status.st_mode) || descriptorOf(place.target) >= 0;
  place.mode = status.st_mode & 0777;
  place.replaces = true;
  const bool isReadOnly = (status.st_mode & 0222) == 0 || ::access(place.target.c_str(), W_OK) != 0;
  if (isReadOnly) {
    refuse(destination, field, "cannot be written: it is read-only", "choose another file, or make it writable");
  }
  return place;
}

int openTemporary(const fs::path& temporary, mode_t mode) {
  return ::open(temporary.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, mode);
}

[[noreturn]] void refuseFolder(const fs::path& destination, const std::string& field, int error) {
  refuse(destination, field, std::string("cannot be written: ") + std::strerror(error), "choose another place",
         kindOf(error));
}

/// A descriptor to write to what is there already, at its beginning or, for a descriptor's own path, where that stands.
int openExisting(const fs::path& target, int flags) {
  const int own = descriptorOf(target);
  return own >= 0 ? ::fcntl(own, F_DUPFD_CLOEXEC, 3) : ::open(target.c_str(), O_WRONLY | O_NOCTTY | O_CLOEXEC | flags);
}

/// All of the bytes, or the error number.
int writeAll(int descriptor, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return written < 0 ? errno : EIO;
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  return 0;
}

}  // namespace

fs::path writtenPath(const fs::path& destination) {
  if (destination.empty()) return {};
  const fs::path target = behindLinks(destination, {});
  std::error_code code;
  const fs::path folder = fs::weakly_canonical(folderOf(target), code);
  return code ? target.lexically_normal() : folder / target.filename();
}

void requireWritable(const fs::path& destination, const std::string& field) {
  const Place place = requirePlace(destination, field);
  if (place.isStraight) return;
  // Asked by doing it: permissions, read-only file systems and full name tables all answer here.
  const fs::path probe = temporaryBeside(place.target);
  const int slot = noteUnfinished(probe.string());
  const int descriptor = openTemporary(probe, 0600);
  const int error = errno;
  if (descriptor >= 0) {
    ::close(descriptor);
    ::unlink(probe.c_str());
  }
  forgetUnfinished(slot);
  if (descriptor < 0) refuseFolder(destination, field, error);
}

OutputFile::OutputFile(const fs::path& destination) : destination_(destination) {
  const Place place = requirePlace(destination, {});
  target_ = place.target;
  if (place.isStraight) return;
  const fs::path temporary = temporaryBeside(target_);
  slot_ = noteUnfinished(temporary.string());
  descriptor_ = openTemporary(temporary, place.replaces ? 0600 : place.mode);
  if (descriptor_ < 0) {
    const int error = errno;
    forgetUnfinished(slot_);
    refuseFolder(destination, {}, error);
  }
  temporary_ = temporary;
  // A file system without permissions may refuse; the content matters more.
  if (place.replaces) static_cast<void>(::fchmod(descriptor_, place.mode) == 0);
}

OutputFile::~OutputFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
  forgetUnfinished(slot_);
}

void OutputFile::fail(int error) const {
  refuse(destination_, {}, std::string("writing failed: ") + std::strerror(error), {}, ErrorKind::failed);
}

void OutputFile::write(std::span<const std::byte> bytes, uint64_t offset) {
  size_ = std::max(size_, offset + bytes.size());
  if (temporary_.empty()) {
    if (straight_.size() < size_) straight_.resize(size_);
    std::ranges::copy(bytes, straight_.begin() + static_cast<std::ptrdiff_t>(offset));
    return;
  }
  while (!bytes.empty()) {
    const ssize_t written = ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) fail(written < 0 ? errno : EIO);
    bytes = bytes.subspan(static_cast<std::size_t>(written));
    offset += static_cast<uint64_t>(written);
  }
}

void OutputFile::placeStraight() {
  const int descriptor = openExisting(target_, 0);
  if (descriptor < 0) fail(errno);
  const int error = writeAll(descriptor, straight_);
  const bool isClosed = ::close(descriptor) == 0;
  if (error != 0 || !isClosed) fail(error != 0 ? error : errno);
}

void OutputFile::copyIntoTarget() {
  const int from = ::open(temporary_.c_str(), O_RDONLY | O_CLOEXEC);
  const int to = from < 0 ? -1 : openExisting(target_, O_TRUNC);
  int error = to < 0 ? errno : 0;
  std::vector<std::byte> piece(std::size_t{1} << 20);
  for (ssize_t count = 1; error == 0 && count > 0;) {
    count = ::read(from, piece.data(), piece.size());
    error = count < 0 ? errno : writeAll(to, std::span(piece).first(static_cast<std::size_t>(count)));
  }
  if (to >= 0 && ::close(to) != 0 && error == 0) error = errno;
  if (from >= 0) ::close(from);
  if (error != 0) fail(error);
}

void OutputFile::place() {
  if (temporary_.empty()) return placeStraight();
  // Some network file systems report a full disk only here or at the close. Others know no fsync at all.
  if (::fsync(descriptor_) != 0 && errno != EINVAL && errno != ENOTSUP) fail(errno);
  const int descriptor = descriptor_;
  descriptor_ = -1;
  if (::close(descriptor) != 0) fail(errno);
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) {
    // A mount point, or another's file in a folder such as /tmp, can be written but not replaced.
    if (errno != EBUSY && errno != EPERM && errno != EACCES && errno != EXDEV) fail(errno);
    copyIntoTarget();
    ::unlink(temporary_.c_str());
  }
  temporary_.clear();
  forgetUnfinished(slot_);
  slot_ = -1;
}

void writeFile(const fs::path& destination, std::string_view content) {
  OutputFile file(destination);
  file.write(std::as_bytes(std::span(content)), 0);
  file.place();
}

}  // namespace lensgraph::engine
