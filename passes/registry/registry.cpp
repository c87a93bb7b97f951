// The list of techniques. docs/new_technique.md says how to add one.
#include "passes/registry/registry.h"

#include <algorithm>

#include "passes/accumulation/accumulation.h"
#include "passes/multilayer_filtering/multilayer_filtering.h"
#include "passes/multiview_synthesis/multiview_synthesis.h"
#include "passes/pinhole/pinhole.h"
#include "passes/two_pass_filter/two_pass_filter.h"

namespace lensgraph::passes {

std::span<const Technique> techniques() {
  static const std::vector<Technique> all = {
      pinhole::technique(),
      accumulation::technique(),
      multiview_synthesis::technique(),
      multilayer_filtering::technique(),
      two_pass_filter::technique(),
  };
  return all;
}

const Technique* findTechnique(std::string_view name) {
  const auto all = techniques();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Technique& one) { return one.name == name; });
  return found == all.end() ? nullptr : &*found;
}

std::string_view nearestTechniqueName(std::string_view name) {
  std::vector<std::string_view> names;
  for (const Technique& one : techniques()) names.push_back(one.name);
  return nearestName(name, names);
}

}  // namespace lensgraph::passes
