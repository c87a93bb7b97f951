// The page of `lensgraph bench`: the document of a bench with its pictures, as one self-contained HTML file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "samples/lensgraph/pages/page_pictures.h"

namespace lensgraph::cli {

struct BenchPageOptions {
  FlipMapMaker flipMap;                        ///< Called for each picture of a result; empty (default): no FLIP maps.
  uint32_t longestSide = kLongestSideInPages;  ///< px; larger pictures are scaled down for the page.
};

/// One self-contained HTML document that draws a bench. `bench`: the document that `lensgraph bench` writes, format
/// version 1. `folder`: where its picture paths start. A picture that is null or whose file is absent is left out, and
/// the page says so at its place. A shot may have "maskPictures", an object of mask name to picture path.
/// Throws engine::Error: the program was built without d3; a picture that is there but cannot be read.
std::string benchPage(const nlohmann::ordered_json& bench, const std::filesystem::path& folder,
                      const BenchPageOptions& options = {});

}  // namespace lensgraph::cli
