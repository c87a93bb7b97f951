// Writes and prints results: see bench_output.h.
#include "samples/lensgraph/commands/bench_output.h"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "engine/files/output_file.h"
#include "engine/metrics/flip.h"
#include "samples/lensgraph/bench/results/bench_document.h"
#include "samples/lensgraph/bench/results/json_values.h"
#include "samples/lensgraph/pages/bench_page.h"
#include "samples/lensgraph/pages/embedded_page.h"

namespace lensgraph::cli {
namespace {

using nlohmann::ordered_json;

/// A number right-aligned in `width` characters; a dash for what is none.
void printNumber(const ordered_json& value, int width, int digits) {
  if (value.is_number()) {
    std::printf("%*.*f", width, digits, value.get<double>());
  } else {
    std::printf("%*s", width, value.is_string() ? value.get<std::string>().c_str() : "-");
  }
}

void printResult(const ordered_json& result) {
  const std::string program = result["program"];
  const std::string name = (program == "this" ? "" : program + ": ") + result["id"].get<std::string>();
  std::printf("  %-44s", name.c_str());
  printNumber(valueAt(result, "/cpuMs/median"), 10, 1);
  const auto& quality = result["quality"];
  printNumber(valueAt(quality, "/psnr"), 9, 2);
  printNumber(valueAt(quality, "/ssim"), 8, 4);
  const auto& ratios = result["ratios"];
  printNumber(valueAt(ratios, "/pinhole"), 10, 2);
  printNumber(valueAt(ratios, "/accumulationAtPsnr"), 9, 2);
  printNumber(valueAt(ratios, "/accumulationAtSsim"), 9, 2);
  std::printf("\n");
}

}  // namespace

void writeBench(const ordered_json& document, const std::filesystem::path& folder) {
  engine::writeFile(folder / "bench.json", document.dump(1, ' ', false, ordered_json::error_handler_t::replace) + "\n");
  engine::writeFile(folder / "bench.csv", benchTable(document));
  for (const auto& shot : document["shots"]) {
    std::printf("%s, %d x %d px, %llu triangles\n", shot["id"].get<std::string>().c_str(), shot["width"].get<int>(),
                shot["height"].get<int>(), static_cast<unsigned long long>(shot["triangles"].get<uint64_t>()));
    std::printf("  %-44s%10s%9s%8s%10s%9s%9s\n", "", "CPU ms", "PSNR dB", "SSIM", "x pinhole", "x acc dB", "x acc SS");
    for (const auto& result : shot["results"]) printResult(result);
  }
  std::printf("results %s\n", (folder / "bench.json").c_str());
  if (d3Script().empty()) return;  // Built without it: everything but the page.
  BenchPageOptions options;
  options.flipMap = [](const engine::FloatImage& picture, const engine::FloatImage& reference, double exposureEv) {
    return engine::flip(picture, reference, {.exposureEv = exposureEv}).map;
  };
  const auto page = folder / "index.html";
  engine::writeFile(page, benchPage(document, folder, options));
  std::printf("page    %s\n", page.c_str());
}

}  // namespace lensgraph::cli
