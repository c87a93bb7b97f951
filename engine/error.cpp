// Puts the parts of an error into its one line.
#include "engine/error.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace lensgraph::engine {
namespace {

constexpr std::string_view kEllipsis = "…";

bool isContinuation(char c) {
  return (static_cast<unsigned char>(c) & 0xC0) == 0x80;
}

// Bytes of the control character that starts here; 0 when none does. Terminals obey some of them.
std::size_t controlLength(std::string_view text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
  if (byte(0) < 0x20 || byte(0) == 0x7f) return 1;
  if (byte(0) == 0xC2 && byte(1) >= 0x80 && byte(1) < 0xA0) return 2;
  if (byte(0) != 0xE2) return 0;
  const std::uint32_t tail = byte(1) << 8 | byte(2);
  const bool isSeparatorOrDirection =
      tail == 0x80A8 || tail == 0x80A9 || (tail >= 0x80AA && tail <= 0x80AE) || (tail >= 0x81A6 && tail <= 0x81A9);
  return isSeparatorOrDirection ? 3 : 0;
}

std::string withoutControls(std::string_view text) {
  std::string line;
  line.reserve(text.size());
  while (!text.empty()) {
    const std::size_t length = controlLength(text);
    line += length == 0 ? text.front() : ' ';
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  while (line.ends_with(' ')) line.pop_back();
  return line;
}

// Head and tail of a text that is too long.
std::string shortened(std::string text, std::size_t limit) {
  if (text.size() <= limit) return text;
  if (limit <= kEllipsis.size()) return std::string(kEllipsis.substr(0, limit == kEllipsis.size() ? limit : 0));
  const std::size_t kept = limit - kEllipsis.size();
  std::size_t head = kept - kept / 2, tail = text.size() - kept / 2;
  while (head > 0 && isContinuation(text[head])) --head;
  while (tail < text.size() && isContinuation(text[tail])) ++tail;
  return text.substr(0, head).append(kEllipsis).append(text, tail);
}

std::string joined(const ErrorParts& parts) {
  std::string line;
  if (!parts.file.empty()) line += parts.file + ": ";
  if (!parts.field.empty()) line += parts.field + ": ";
  line += parts.reason;
  if (!parts.remedy.empty()) line += "; " + parts.remedy;
  return line;
}

ErrorParts shortened(const ErrorParts& parts, std::size_t limit) {
  return {.file = asLine(parts.file, limit),
          .field = asLine(parts.field, limit),
          .reason = asLine(parts.reason, limit),
          .remedy = asLine(parts.remedy, limit)};
}

std::string lineOf(const ErrorParts& whole) {
  // A file may put megabytes into one part.
  const ErrorParts parts = shortened(whole, kLongestLine);
  std::string line = joined(parts);
  for (std::size_t limit = kLongestLine; line.size() > kLongestLine; limit -= 10)
    line = joined(shortened(parts, limit));
  return asLine(line);
}

}  // namespace

std::string asLine(std::string_view text, std::size_t limit) {
  return shortened(withoutControls(text), limit);
}

Error::Error(ErrorParts parts, ErrorKind kind)
    : std::runtime_error(lineOf(parts)), parts_(std::move(parts)), kind_(kind) {}

Error::Error(const std::string& reason, ErrorKind kind)
    : Error(ErrorParts{.file = {}, .field = {}, .reason = reason, .remedy = {}}, kind) {}

}  // namespace lensgraph::engine
