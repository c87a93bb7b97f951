// How near the multiview synthesis comes to the truth (figures 6 to 10 of Lee, Eisemann, Seidel 2009, by number): with the
// paper's 32 samples, with 256, and with several views; what its options are worth.
//
//   lee2009_accuracy -o docs/results/multiview_synthesis_llvmpipe.json SHOT.json…
//
// The reference is dof.exr beside the shot where there is one (ray-traced), else accumulation of 1024 views.
#include "measure.h"

using namespace lensgraph;

namespace {

using nlohmann::ordered_json;
using passes::ParameterSet;

ordered_json rowsOf(host::Renderer& renderer, const host::Shot& shot, const std::string& file) {
  const auto reference = papers::referenceOf(renderer, shot, file);
  const int64_t few = 32, many = 256;
  std::vector<ParameterSet> sets = {
      {{"lensSamples", few}},
      {{"lensSamples", few}, {"jitter", std::string("none")}},
      {{"lensSamples", few}, {"jitter", std::string("noise")}},
      {{"lensSamples", few}, {"coneWidth", 0.0}},
      {{"lensSamples", few}, {"culling", false}},
      {{"lensSamples", many}},
      {{"lensSamples", many}, {"splitTriangles", false}},
      {{"lensSamples", many}, {"border", 0.0}},
      {{"lensSamples", many}, {"views", int64_t{4}}},
      {{"lensSamples", many}, {"views", int64_t{16}}},
  };
  sets.push_back({{"lensSamples", int64_t{64}}});
  for (const char* search : {"falsePosition", "falsePositionInDepth"}) {
    for (const int64_t iterations : {1, 2, 3}) {
      sets.push_back({{"lensSamples", int64_t{64}}, {"search", std::string(search)}, {"iterations", iterations}});
    }
  }
  if (shot.shading == host::Shading::lit) {
    sets.push_back({{"lensSamples", many}, {"viewDependent", true}});
    sets.push_back({{"lensSamples", many}, {"viewDependent", true}, {"views", int64_t{16}}});
  }
  ordered_json rows = ordered_json::array();
  for (const auto& set : sets) rows.push_back(papers::measure(renderer, shot, "multiview_synthesis", set, reference));
  return rows;
}

}  // namespace

int main(int argc, char** argv) {
  return papers::run(argc, argv, rowsOf);
}
