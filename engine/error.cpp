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

}  // namespace lensgraph::engine
