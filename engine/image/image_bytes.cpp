// Reads a picture file into memory: see image_bytes.h.
#include "engine/image/image_bytes.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "engine/image/image_format.h"

namespace lensgraph::engine {
namespace {

/// Closes the file when it goes out of scope.
struct Descriptor {
  int number;
  ~Descriptor() {
    if (number >= 0) ::close(number);
  }
};

}  // namespace

std::vector<std::byte> readImageBytes(const std::filesystem::path& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) failImage(path, "no such file");
  if (std::filesystem::is_directory(status)) failImage(path, "is a folder, not an image");
  if (!std::filesystem::is_regular_file(status)) failImage(path, "is not a file", "pipes and devices are not read");
  const auto reason = [] { return "cannot be read: " + std::generic_category().message(errno); };
  // Not blocking, in case a pipe has taken the file's place since.
  const Descriptor file{::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)};
  if (file.number < 0) failImage(path, reason());
  struct stat facts {};
  if (::fstat(file.number, &facts) != 0) failImage(path, reason());
  if (!S_ISREG(facts.st_mode)) failImage(path, "is not a file", "pipes and devices are not read");
  if (facts.st_size == 0) failImage(path, "is empty (0 bytes)");

  std::vector<std::byte> bytes(static_cast<size_t>(facts.st_size));
  size_t done = 0;
  while (done < bytes.size()) {
    constexpr size_t kMost = size_t{1} << 30;  // what one call may read is limited
    const ssize_t count = ::read(file.number, bytes.data() + done, std::min(kMost, bytes.size() - done));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) failImage(path, reason());
    if (count == 0) break;  // it has become shorter meanwhile
    done += static_cast<size_t>(count);
  }
  bytes.resize(done);
  if (bytes.empty()) failImage(path, "is empty (0 bytes)");
  return bytes;
}

}  // namespace lensgraph::engine
