// What is found on the way and stops nothing, put into few lines: each kind once, however often it is found. Private to
// engine/gltf.
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace lensgraph::engine::gltf {

class Warnings {
 public:
  /// `text` is the kind, the same for all places where it is found; `place` is the field, empty for what concerns the
  /// whole file.
  void add(const std::string& text, const std::string& place = {});

  /// One line for each kind in the order in which they were first found: "file: place: text", and from the second place
  /// on "file: text (100,000 of them)". No longer than kLongestLine of engine/error.h.
  std::vector<std::string> lines(const std::string& file) const;

 private:
  std::map<std::string, std::set<std::string>> places_;  ///< By kind; a place that is found twice counts once.
  std::vector<std::string_view> order_;                  ///< Keys of places_.
};

}  // namespace lensgraph::engine::gltf
