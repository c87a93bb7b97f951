// The one exception of the engine's edges: files, parameters, devices. One line: file, field, reason, remedy.
#pragma once

#include <cstddef>
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

/// No line that the engine makes for a user is longer, in bytes of UTF-8.
inline constexpr std::size_t kLongestLine = 500;

/// Text from a file or a library as part of a line: control characters (C0, C1, line and paragraph separators, marks
/// that turn the direction of writing) become blanks, those at the end are cut off, and of a text longer than `limit`
/// bytes the middle becomes "…". Characters of UTF-8 stay whole; other bytes stay as they are.
std::string asLine(std::string_view text, std::size_t limit = kLongestLine);

/// what() is a single line "file: field: reason; remedy", made by asLine(). When it would be longer than kLongestLine, the
/// longest parts are shortened first, so that a long name hides none of the others. parts() keeps all.
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

}  // namespace lensgraph::engine
