// Table 1 of Lee, Eisemann, Seidel 2009: time by number of lens samples N, number of layers M and number of triangles,
// beside the accumulation buffer; and, which the paper has for one picture only, SSIM and PSNR of each.
//
//   generate_scenes --scaling 60000 -o S/stones_60k.glb, and so on with 300000 and 1500000
//   lee2009_table1 -o docs/results/lee2009_table1_llvmpipe.json S/stones_60k.json S/stones_300k.json S/stones_1500k.json
#include "measure.h"

using namespace lensgraph;

namespace {

using nlohmann::ordered_json;

ordered_json rowsOf(host::Renderer& renderer, const host::Shot& shot, const std::string&) {
  // Another pattern than that of the techniques, so that none is nearer to it for its points' sake.
  const auto reference = papers::pictureOf(
      renderer, shot, "accumulation",
      {{"lensSamples", int64_t{256}}, {"pattern", std::string("halton")}, {"viewsPerFrame", int64_t{4}}});
  ordered_json rows = ordered_json::array();
  for (const int64_t samples : {8, 16, 32, 64}) {
    rows.push_back(papers::measure(renderer, shot, "accumulation", {{"lensSamples", samples}}, reference));
  }
  for (const int64_t samples : {8, 16, 32, 64, 256}) {
    for (const int64_t layers : {8, 12, 16}) {
      rows.push_back(papers::measure(renderer, shot, "multiview_synthesis",
                                     {{"lensSamples", samples}, {"layers", layers}}, reference));
    }
  }
  return rows;
}

}  // namespace

int main(int argc, char** argv) {
  return papers::run(argc, argv, rowsOf);
}
