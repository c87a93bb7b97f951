// The one exception of the engine's edges: files, parameters, devices. One line: file, field, reason, remedy.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace lensgraph::engine {

/// Who can mend it. The command line turns it into an exit code.
enum class ErrorKind {
  badInput,  ///< A file or a parameter is wrong or missing: exit code 2.
  failed,    ///< The input is fine, the work failed (disk full, device lost): exit code 1.
};

/// What went wrong, in parts. Every part but the reason may be empty.
struct ErrorParts {
  std::string file;    ///< Path as the user gave it.
  std::string field;   ///< Place inside the file, such as "meshes[2].primitives[0].indices", or a parameter's name.
  std::string reason;  ///< What is wrong, in words, with the offending value.
  std::string remedy;  ///< What to do about it, where something can be done.
};

/// what() is a single line "file: field: reason; remedy". Line breaks inside the parts become spaces.
class Error : public std::runtime_error {
 public:
  explicit Error(ErrorParts parts, ErrorKind kind = ErrorKind::badInput);
  explicit Error(const std::string& reason, ErrorKind kind = ErrorKind::badInput);

  const ErrorParts& parts() const { return parts_; }
  ErrorKind kind() const { return kind_; }

 private:
  ErrorParts parts_;
  ErrorKind kind_;
};

/// A text of a file for a message: whole when it has at most `bytes` bytes, else its beginning and an ellipsis, together no
/// longer. UTF-8 characters stay whole. Precondition: bytes is 8 or more.
std::string shortened(std::string_view text, std::size_t bytes);

}  // namespace lensgraph::engine
