// What a benchmark has measured so far, kept in its folder line by line, so that one that was interrupted goes on where it
// stopped.
//
// DIR/journal.jsonl: the first line says which benchmark this is; each further line is one record, written as soon as it
// is known. A last line that was cut off by the end of the process is dropped.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <unordered_map>
#include <vector>

namespace lensgraph::cli {

class Journal {
 public:
  /// Opens the journal of a folder, or starts it. `identity` is an object of texts: what must not change between two runs
  /// into one folder. Throws engine::Error (bad input): the folder's journal differs in one of them (the error names it);
  /// another process writes it now; it cannot be read or written.
  Journal(const std::filesystem::path& folder, const nlohmann::ordered_json& identity);
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// The record with this key; null when there is none. Valid until the next add().
  const nlohmann::ordered_json* find(const std::string& key) const;
  /// Adds a record and writes it. Precondition: none has this key. Throws engine::Error (failed) on a full disk.
  void add(const std::string& key, nlohmann::ordered_json record);
  /// In the order in which they were added.
  const std::vector<nlohmann::ordered_json>& records() const { return records_; }

 private:
  void read(const nlohmann::ordered_json& identity);
  [[noreturn]] void failForeign() const;
  void take(nlohmann::ordered_json line);
  void append(const nlohmann::ordered_json& line);

  std::filesystem::path file_;
  int descriptor_ = -1;
  std::vector<nlohmann::ordered_json> records_;
  std::unordered_map<std::string, std::size_t> indices_;
};

}  // namespace lensgraph::cli
