// The bench that tests of its page draw: see bench_document.h.
#include "bench_document.h"

#include <string>
#include <vector>

#include "engine/image/image_io.h"
#include "engine/image/srgb.h"

namespace lensgraph::page_test {
namespace {

using json = nlohmann::ordered_json;
using std::filesystem::path;

json spread(double median) {
  return {{"median", median},
          {"min", 0.9 * median},
          {"max", 1.2 * median},
          {"samples", {0.9 * median, median, 1.2 * median}}};
}

json times(double cpuMs) {
  return {{"cpuMs", spread(cpuMs)}, {"wallMs", spread(cpuMs / 2)}, {"gpuMs", spread(cpuMs / 4)}};
}

/// Units of which every sample is the same.
json unit(double ms) {
  const json spread = {{"median", ms}, {"min", ms}, {"max", ms}, {"samples", {ms, ms, ms}}};
  return {{"cpuMs", spread}, {"wallMs", spread}, {"gpuMs", spread}};
}

struct Variant {
  std::string program, technique;
  json changed;
  double overPinhole;
  json psnr;
  double ssim;
  std::vector<int> color;
};

constexpr double kPinholeMs = 10.0;

json resultOf(const Variant& variant, const path& folder, const path& pictures) {
  std::string id = variant.technique;
  for (const auto& [name, value] : variant.changed.items()) id += " " + name + "=" + value.dump();
  json result = {{"id", id},
                 {"program", variant.program},
                 {"technique", variant.technique},
                 {"parameters", variant.changed},
                 {"changed", variant.changed}};
  result.update(times(kPinholeMs * variant.overPinhole));
  result["memory"] = {{"graphBytes", 2 << 20}, {"processBytes", 64 << 20}};
  const json edge = {{"psnr", 12.0 + variant.overPinhole}, {"ssim", 0.5}, {"pixels", 40}};
  result["quality"] = {{"psnr", variant.psnr},
                       {"ssim", variant.ssim},
                       {"flip", 1.0 - variant.ssim},
                       {"relativeRmse", 0.1},
                       {"maxError", 0.4},
                       {"nonFinitePixels", 0},
                       {"masks", {{"nearEdge", edge}, {"highlight", nullptr}}}};
  const bool isOld = variant.program == "old";
  result["ratios"] = {{"pinhole", variant.overPinhole},
                      {"copy", 10 * variant.overPinhole},
                      {"programs", {{"old", variant.technique == "blurred" && !isOld ? json(0.5) : json()}}},
                      {"accumulationAtPsnr", variant.overPinhole > 1 ? json(variant.overPinhole / 8) : json()},
                      {"accumulationAtSsim", nullptr}};
  result["picture"] = nullptr;
  if (!isOld) {
    const path file = pictures / (std::to_string(variant.color[0]) + "_" + std::to_string(variant.color[1]) + ".exr");
    engine::writeImage(folder / file, plainPicture(variant.color[0], variant.color[1], variant.color[2]));
    result["picture"] = file.string();
  }
  result["passes"] = json::array();
  for (const char* pass : {".view", ".spread <wide>"}) {
    if (!isOld) result["passes"].push_back({{"name", variant.technique + pass}, {"ms", 1.5}});
  }
  return result;
}

json shotOf(const std::string& id, const std::vector<Variant>& variants, const path& folder) {
  const path pictures = path("pictures") / id;
  std::filesystem::create_directories(folder / pictures);
  engine::writeImage(folder / pictures / "reference.exr", plainPicture(60, 120, 180));
  json shot = {
      {"id", id},
      {"name", "The " + id},
      {"file", id + ".json"},
      {"sceneHash", "0123456789abcdef"},
      {"triangles", 5230},
      {"width", kPictureWidth},
      {"height", kPictureHeight},
      {"reference", {{"kind", "accumulation"}, {"samples", 1024}, {"picture", (pictures / "reference.exr").string()}}},
      {"masks", {{"nearEdge", 0.031}, {"highlight", 0.0}}},
      {"units", {{"pinhole", unit(kPinholeMs)}, {"copy", unit(1)}, {"accumulationView", unit(kPinholeMs)}}},
      {"accumulation", json::array()},
      {"results", json::array()}};
  for (const int samples : {4, 8, 16, 32}) {
    shot["accumulation"].push_back({{"samples", samples},
                                    {"psnr", 20.0 + samples / 4.0},
                                    {"ssim", 0.5 + samples / 100.0},
                                    {"flip", 1.0 / samples}});
  }
  for (const Variant& variant : variants) shot["results"].push_back(resultOf(variant, folder, pictures));
  return shot;
}

}  // namespace

engine::FloatImage plainPicture(int red, int green, int blue) {
  engine::FloatImage picture(kPictureWidth, kPictureHeight, 3);
  const float color[] = {static_cast<float>(red), static_cast<float>(green), static_cast<float>(blue)};
  for (std::size_t i = 0; i < picture.samples.size(); ++i) {
    picture.samples[i] = engine::linearFromSrgb(color[i % 3] / 255.0f);
  }
  return picture;
}

json benchDocument(const path& folder) {
  const std::vector<Variant> variants = {
      {"this", "sharp", json::object(), 1, 15.0, 0.6, {200, 0, 0}},
      {"this", "blurred", json::object(), 2, 30.0, 0.9, {100, 120, 140}},
      {"old", "blurred", json::object(), 4, 30.0, 0.9, {}},
      {"this", "traced", {{"rays", 8}}, 5, 28.0, 0.8, {60, 100, 180}},
      {"this", "traced", {{"rays", 32}}, 10, 40.0, 0.97, {60, 121, 180}},
  };
  const std::vector<Variant> fewer = {{"this", "sharp", json::object(), 1, "infinity", 1.0, {60, 120, 180}}};
  return {{"format", "lensgraph bench"},
          {"formatVersion", 1},
          {"name", "small"},
          {"date", "2026-12-01T15:00:00Z"},
          {"programs",
           {{{"name", "this"}, {"version", "lensgraph 0.9.0"}, {"commit", "ec59a42"}},
            {{"name", "old"}, {"version", "lensgraph 0.8.0"}, {"commit", "08b1ff7"}}}},
          {"device", {{"name", "A </script> device"}, {"type", "cpu"}, {"driver", "Mesa 22.3.6"}}},
          {"host", {{"processor", "AMD EPYC 7B13"}, {"cores", 2}}},
          {"settings", {{"repeats", 3}, {"exposureEv", 0}, {"referenceSamples", 1024}}},
          {"shots", {shotOf("street", variants, folder), shotOf("room", fewer, folder)}}};
}

}  // namespace lensgraph::page_test
