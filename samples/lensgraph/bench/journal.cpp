// One record a line, appended and never rewritten: see journal.h.
#include "samples/lensgraph/bench/journal.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <sstream>
#include <system_error>

#include "engine/error.h"

namespace lensgraph::cli {
namespace {

using nlohmann::ordered_json;

std::string textOf(const ordered_json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

}  // namespace

Journal::Journal(const std::filesystem::path& folder, const ordered_json& identity) : file_(folder / "journal.jsonl") {
  descriptor_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (descriptor_ < 0) {
    throw engine::Error({.file = file_.string(),
                         .field = {},
                         .reason = "cannot be opened: " + std::generic_category().message(errno),
                         .remedy = "choose another folder"});
  }
  // Some network file systems know no locks: there nothing keeps two processes apart.
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    ::close(descriptor_);
    throw engine::Error({.file = file_.string(),
                         .field = {},
                         .reason = "another benchmark is writing it",
                         .remedy = "wait until it has ended, or choose another folder"});
  }
  try {
    read(identity);
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
}

Journal::~Journal() {
  ::close(descriptor_);
}

void Journal::read(const ordered_json& identity) {
  std::ifstream stream(file_, std::ios::binary);
  std::ostringstream content;
  content << stream.rdbuf();
  const std::string text = content.str();
  const std::size_t end = text.rfind('\n') + 1;  // 0 when there is no whole line.
  if (end == 0 && !text.empty() && text.front() != '{') failForeign();
  if (::ftruncate(descriptor_, static_cast<off_t>(end)) != 0) {
    throw engine::Error(file_.string() + ": cannot be written", engine::ErrorKind::failed);
  }
  if (end == 0) {
    append(identity);
    return;
  }
  std::istringstream lines(text.substr(0, end));
  std::string line;
  for (bool isFirst = true; std::getline(lines, line); isFirst = false) {
    auto value = ordered_json::parse(line, nullptr, false);
    if (!value.is_object()) {
      failForeign();
    }
    if (!isFirst) {
      take(std::move(value));
      continue;
    }
    for (const auto& [name, wanted] : identity.items()) {
      const std::string found = value.contains(name) ? textOf(value[name]) : "absent";
      if (found == textOf(wanted)) continue;
      throw engine::Error({.file = file_.string(),
                           .field = name,
                           .reason = "is " + found + ", this benchmark's is " + textOf(wanted),
                           .remedy = "choose another folder"});
    }
  }
}

void Journal::failForeign() const {
  throw engine::Error({.file = file_.string(),
                       .field = {},
                       .reason = "is no journal of a benchmark",
                       .remedy = "remove it, or choose another folder"});
}

void Journal::take(ordered_json line) {
  indices_[line.value("key", "")] = records_.size();
  records_.push_back(std::move(line));
}

void Journal::append(const ordered_json& line) {
  const std::string text = line.dump(-1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
  std::size_t done = 0;
  while (done < text.size()) {
    const auto written = ::write(descriptor_, text.data() + done, text.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) {
      throw engine::Error(file_.string() + ": cannot be written: " + std::generic_category().message(errno),
                          engine::ErrorKind::failed);
    }
    done += static_cast<std::size_t>(written);
  }
}

const ordered_json* Journal::find(const std::string& key) const {
  const auto found = indices_.find(key);
  return found == indices_.end() ? nullptr : &records_[found->second];
}

void Journal::add(const std::string& key, ordered_json record) {
  ordered_json line = {{"key", key}};
  line.update(record);
  append(line);
  take(std::move(line));
}

}  // namespace lensgraph::cli
