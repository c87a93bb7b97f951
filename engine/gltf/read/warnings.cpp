// Merges warnings of one kind.
#include "engine/gltf/read/warnings.h"

#include "engine/error.h"

namespace lensgraph::engine::gltf {
namespace {

// Of one line, what its file and its text may take; the rest is for the place and the count.
constexpr size_t kLongestPart = 200;

// 100000 as "100,000".
std::string grouped(size_t number) {
  std::string digits = std::to_string(number);
  for (size_t end = digits.size(); end > 3; end -= 3) digits.insert(end - 3, ",");
  return digits;
}

}  // namespace

void Warnings::add(const std::string& text, const std::string& place) {
  const auto [found, isNew] = places_.try_emplace(text);
  if (isNew) order_.push_back(found->first);
  if (!place.empty()) found->second.insert(place);
}

std::vector<std::string> Warnings::lines(const std::string& file) const {
  std::vector<std::string> result;
  for (std::string_view kind : order_) {
    const std::set<std::string>& places = places_.at(std::string(kind));
    std::string line = asLine(file, kLongestPart) + ": ";
    if (places.size() == 1) line += asLine(*places.begin(), kLongestPart / 2) + ": ";
    line += asLine(kind, kLongestPart);
    if (places.size() > 1) line += " (" + grouped(places.size()) + " of them)";
    result.push_back(asLine(line));
  }
  return result;
}

}  // namespace lensgraph::engine::gltf
