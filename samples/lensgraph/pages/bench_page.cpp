// The page of a bench: see bench_page.h. What the page shows is drawn by bench_page.js and its parts, in the browser.
#include "samples/lensgraph/pages/bench_page.h"

#include <nlohmann/json.hpp>
#include <optional>

#include "engine/image/image_io.h"
#include "samples/lensgraph/pages/embedded_page.h"
#include "samples/lensgraph/pages/shared_page.h"

namespace lensgraph::cli {
namespace {

using nlohmann::ordered_json;
using std::filesystem::path;

constexpr char kPage[] = {
#include "generated/bench_page.inc"
};
constexpr char kScript[] = {
#include "generated/bench_page_script.inc"
};

/// The picture that a field names; none where it is absent, null or the file is not there.
std::optional<engine::FloatImage> pictureOf(const ordered_json& object, const char* field, const path& folder) {
  const auto found = object.find(field);
  if (found == object.end() || !found->is_string()) return std::nullopt;
  const path file = folder / found->get<std::string>();
  std::error_code code;
  if (!std::filesystem::exists(file, code)) return std::nullopt;
  return engine::readImage(file);
}

/// Replaces paths of a shot's pictures by the pictures.
class PictureEmbedder {
 public:
  PictureEmbedder(const path& folder, const BenchPageOptions& options, double exposureEv)
      : folder_(folder), options_(options), exposureEv_(exposureEv) {}

  void embedInto(ordered_json& shot) const {
    std::optional<engine::FloatImage> reference;
    if (const auto found = shot.find("reference"); found != shot.end() && found->is_object()) {
      reference = pictureOf(*found, "picture", folder_);
      (*found)["picture"] = uriOrNull(reference);
    }
    for (auto& result : shot.at("results")) {
      const auto picture = pictureOf(result, "picture", folder_);
      result["picture"] = uriOrNull(picture);
      if (picture && reference && options_.flipMap) {
        result["flipMap"] = mapUri(options_.flipMap(*picture, *reference, exposureEv_), options_.longestSide);
      }
    }
    if (const auto masks = shot.find("maskPictures"); masks != shot.end() && masks->is_object()) {
      for (const auto& [name, file] : masks->items()) {
        const auto mask = pictureOf(*masks, name.c_str(), folder_);
        (*masks)[name] = mask ? ordered_json(mapUri(*mask, options_.longestSide)) : ordered_json();
      }
    }
  }

 private:
  ordered_json uriOrNull(const std::optional<engine::FloatImage>& picture) const {
    if (!picture) return nullptr;
    return pictureUri(*picture, exposureEv_, options_.longestSide);
  }

  const path& folder_;
  const BenchPageOptions& options_;
  double exposureEv_;
};

}  // namespace

std::string benchPage(const ordered_json& bench, const path& folder, const BenchPageOptions& options) {
  requireD3("bench");
  const auto settings = bench.value("settings", ordered_json::object());
  const PictureEmbedder embedder(folder, options, settings.value("exposureEv", 0.0));
  ordered_json document = bench;
  for (auto& shot : document.at("shots")) embedder.embedInto(shot);
  return filledPage(textOf(kPage), textOf(kScript), document);
}

}  // namespace lensgraph::cli
