// What tests of the multi-layer filtering share.
#pragma once

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/test_scenes.h"

namespace lensgraph::multilayer_test {

using passes::ParameterSet;
using support::render;

inline constexpr const char* kName = "multilayer_filtering";

inline const glm::vec3 kColor(0.25f, 3.0f, 0.05f);

inline std::string described(const ParameterSet& set) {
  std::string text;
  for (const auto& [name, value] : set) text += ", " + name + " " + passes::toString(value);
  return text;
}

inline ParameterSet with(ParameterSet set, const ParameterSet& more) {
  for (const auto& [name, value] : more) set[name] = value;
  return set;
}

/// The paper's filter configurations, and ours.
inline std::vector<ParameterSet> configurations() {
  const auto steps = [](int64_t mip, int64_t stack) -> ParameterSet {
    return {{"mipSteps", mip}, {"stackSteps", stack}};
  };
  return {{},          steps(1, 3),  steps(2, 2),
          steps(4, 0), steps(0, -1), steps(2, -1),
          steps(0, 4), steps(13, 0), {{"antialiasing", std::string("2x2")}}};
}

class MultilayerFiltering : public support::GpuTest {
 protected:
  host::Rendering rendering(const engine::Scene& scene, const host::Shot& shot, const ParameterSet& parameters = {}) {
    host::Renderer renderer(support::device(), scene, std::nullopt);
    return render(renderer, shot, kName, parameters);
  }
  engine::FloatImage picture(const engine::Scene& scene, const host::Shot& shot, const ParameterSet& parameters = {}) {
    return rendering(scene, shot, parameters).color;
  }
};

/// Largest relative difference of any channel from one colour.
inline double distanceFrom(const engine::FloatImage& picture, const glm::vec3& color) {
  double largest = 0.0;
  for (std::size_t i = 0; i < picture.pixelCount(); ++i) {
    for (int c = 0; c < 3; ++c) {
      largest = std::max(largest, std::abs(double(picture.samples[4 * i + c]) / double(color[c]) - 1.0));
    }
  }
  return largest;
}

}  // namespace lensgraph::multilayer_test
