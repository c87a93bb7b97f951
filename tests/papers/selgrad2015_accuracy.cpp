// How near the multi-layer filtering (Selgrad, Reintges, Penk, Wagner, Stamminger 2015) comes to the truth, option by option,
// beside a multiview synthesis of 16 rays (the paper's fig. 12, bottom) and the two-pass filter.
//
//   selgrad2015_accuracy -o docs/results/multilayer_filtering_llvmpipe.json SHOT.json…
//
// The reference is dof.exr beside the shot where there is one (ray-traced), else accumulation of 1024 views.
#include "measure.h"

using namespace lensgraph;

namespace {

using nlohmann::ordered_json;
using passes::ParameterSet;

ordered_json rowsOf(host::Renderer& renderer, const host::Shot& shot, const std::string& file) {
  const auto reference = papers::referenceOf(renderer, shot, file);
  const std::vector<ParameterSet> sets = {
      {},
      {{"antialiasing", std::string("2x2")}},
      {{"antialiasing", std::string("2x2")}, {"listLength", int64_t{8}}},
      {{"kernel", std::string("box")}},
      {{"mipSteps", int64_t{0}}},
      {{"mipSteps", int64_t{2}}},
      {{"mipSteps", int64_t{13}}},
      {{"mipSteps", int64_t{1}}, {"stackSteps", int64_t{3}}},
      {{"listLength", int64_t{1}}},
      {{"listLength", int64_t{2}}},
      {{"listLength", int64_t{16}}},
      {{"blend", std::string("additive")}},
      {{"faces", std::string("all")}},
      {{"faces", std::string("front")}},
      {{"levelMatch", std::string("diameter")}},
      {{"epsilon", 0.1}},
      {{"epsilon", 0.5}},
      {{"linkDistance", 0.0}},
      {{"interpolateLevels", false}},
      {{"bilinear", false}},
      {{"truncation", false}},
      {{"border", 0.0}},
      // The paper's settings, where they are known, with as many levels as the blur asks for.
      {{"blend", std::string("additive")},
       {"faces", std::string("front")},
       {"levelMatch", std::string("diameter")},
       {"border", 0.0}},
  };
  ordered_json rows = ordered_json::array();
  for (const auto& set : sets) rows.push_back(papers::measure(renderer, shot, "multilayer_filtering", set, reference));
  rows.push_back(papers::measure(renderer, shot, "multiview_synthesis", {{"lensSamples", int64_t{16}}}, reference));
  rows.push_back(papers::measure(renderer, shot, "multiview_synthesis", {{"lensSamples", int64_t{256}}}, reference));
  rows.push_back(papers::measure(renderer, shot, "two_pass_filter", {}, reference));
  return rows;
}

}  // namespace

int main(int argc, char** argv) {
  return papers::run(argc, argv, rowsOf);
}
