// A small bench as `lensgraph bench` writes it: two shots, two programs, three techniques, pictures of one color each.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "engine/image/image.h"

namespace lensgraph::page_test {

inline constexpr uint32_t kPictureWidth = 24, kPictureHeight = 16;  // px

/// A picture of one color, displayed as these 8-bit sRGB values.
engine::FloatImage plainPicture(int red, int green, int blue);

/// The bench; writes its pictures below the folder. On the shot "street", by ratio to the pinhole frame and PSNR:
/// sharp 1 and 15 dB; blurred 2 and 30 dB, of the program "old" 4; traced with 8 rays 5 and 28 dB, with 32 rays 10 and
/// 40 dB. The Pareto front is sharp, blurred, traced with 32. Reference (60, 120, 180), blurred (100, 120, 140).
nlohmann::ordered_json benchDocument(const std::filesystem::path& folder);

}  // namespace lensgraph::page_test
