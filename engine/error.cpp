// Puts the parts of an error into its one line.
#include "engine/error.h"

#include <utility>

namespace lensgraph::engine {
namespace {

// File names and library messages may hold line breaks; an error stays one line.
std::string onOneLine(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  }
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

std::string lineOf(const ErrorParts& parts) {
  std::string line;
  if (!parts.file.empty()) line += parts.file + ": ";
  if (!parts.field.empty()) line += parts.field + ": ";
  line += parts.reason;
  if (!parts.remedy.empty()) line += "; " + parts.remedy;
  return onOneLine(std::move(line));
}

}  // namespace

Error::Error(ErrorParts parts, ErrorKind kind)
    : std::runtime_error(lineOf(parts)), parts_(std::move(parts)), kind_(kind) {}

Error::Error(const std::string& reason, ErrorKind kind)
    : Error(ErrorParts{.file = {}, .field = {}, .reason = reason, .remedy = {}}, kind) {}

std::string shortened(std::string_view text, std::size_t bytes) {
  constexpr std::string_view kEllipsis = "…";
  if (text.size() <= bytes) return std::string(text);
  std::size_t end = bytes - kEllipsis.size();
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0u) == 0x80u) --end;
  return std::string(text.substr(0, end)).append(kEllipsis);
}

}  // namespace lensgraph::engine
