// Checks a document of results: see bench_file.h.
#include "samples/lensgraph/bench/results/bench_file.h"

#include <fstream>
#include <nlohmann/json.hpp>

#include "engine/error.h"
#include "samples/host/json_reader.h"
#include "samples/lensgraph/bench/results/bench_document.h"

namespace lensgraph::cli {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;
using std::filesystem::path;

struct FieldType {
  const char* name;
  json::value_t type;
};

constexpr FieldType kDocumentFields[] = {{"name", json::value_t::string},     {"programs", json::value_t::array},
                                         {"device", json::value_t::object},   {"host", json::value_t::object},
                                         {"settings", json::value_t::object}, {"shots", json::value_t::array}};
constexpr FieldType kShotFields[] = {{"id", json::value_t::string},
                                     {"case", json::value_t::string},
                                     {"sceneHash", json::value_t::string},
                                     {"width", json::value_t::number_unsigned},
                                     {"height", json::value_t::number_unsigned},
                                     {"triangles", json::value_t::number_unsigned},
                                     {"reference", json::value_t::object},
                                     {"units", json::value_t::object},
                                     {"accumulation", json::value_t::array},
                                     {"results", json::value_t::array}};
constexpr FieldType kResultFields[] = {{"id", json::value_t::string},        {"program", json::value_t::string},
                                       {"technique", json::value_t::string}, {"cpuMs", json::value_t::object},
                                       {"wallMs", json::value_t::object},    {"gpuMs", json::value_t::object},
                                       {"quality", json::value_t::object},   {"ratios", json::value_t::object}};

class Checker {
 public:
  explicit Checker(const path& file) : file_(file) {}

  [[noreturn]] void fail(const std::string& field, const std::string& reason) const {
    throw engine::Error(
        {.file = file_.string(), .field = field, .reason = reason, .remedy = "give a file that lensgraph bench wrote"});
  }

  template <std::size_t count>
  void require(const json& object, const FieldType (&fields)[count], const std::string& place) const {
    if (!object.is_object()) fail(place, "is no object");
    for (const FieldType& field : fields) {
      const std::string name = place.empty() ? field.name : place + "." + field.name;
      if (!object.contains(field.name)) fail(name, "is missing");
      if (object[field.name].type() != field.type) fail(name, "is of another type than expected");
    }
  }

  /// A spread is null, or has numbers.
  void requireSpread(const json& object, const char* field, const std::string& place) const {
    const json& spread = object[field];
    if (spread.is_null()) return;
    for (const char* name : {"median", "min", "max"}) {
      const bool isNumber = spread.is_object() && spread.contains(name) && spread[name].is_number();
      if (!isNumber) fail(place + "." + field + "." + name, "is no number");
    }
  }

 private:
  path file_;
};

}  // namespace

ordered_json readBenchFile(const path& fileOrFolder) {
  std::error_code code;
  const path file = std::filesystem::is_directory(fileOrFolder, code) ? fileOrFolder / "bench.json" : fileOrFolder;
  const json document = host::readJsonFile(file);
  const Checker checker(file);
  if (!document.is_object() || !document.contains("format") || document["format"] != kBenchFormat) {
    checker.fail("format", "is no benchmark's");
  }
  if (!document.contains("formatVersion") || document["formatVersion"] != kBenchVersion) {
    checker.fail("formatVersion", "is not " + std::to_string(kBenchVersion));
  }
  checker.require(document, kDocumentFields, "");
  std::size_t index = 0;
  for (const auto& shot : document["shots"]) {
    const std::string place = "shots[" + std::to_string(index++) + "]";
    checker.require(shot, kShotFields, place);
    std::size_t result = 0;
    for (const auto& each : shot["results"]) {
      const std::string at = place + ".results[" + std::to_string(result++) + "]";
      checker.require(each, kResultFields, at);
      for (const char* clock : {"cpuMs", "wallMs", "gpuMs"}) {
        if (!each.contains(clock)) checker.fail(at + "." + clock, "is missing");
        checker.requireSpread(each, clock, at);
      }
    }
  }
  std::ifstream stream(file);
  return ordered_json::parse(stream);  // Again, since `json` sorts its fields.
}

}  // namespace lensgraph::cli
