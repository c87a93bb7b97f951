// Which levels of filtering a picture needs, and where their cells lie (Selgrad, Reintges, Penk, Wagner, Stamminger 2015,
// §5.2 and §6.1). Pure.
//
// Level L is filtered by a box of 2^L of the lists' pixels. The first levels halve the resolution (mip map), further ones
// keep it and take taps 2^(L-1) apart (filter stack): the Y-map of §5.2. With antialiasing (ours) lists are of finer pixels
// than the picture's, the first mip steps lead to those, and that level is the finest to show.
#pragma once

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <vector>

#include "shaders/shared/multilayer_filtering.h"

namespace lensgraph::passes::multilayer_filtering {

/// The shape of the blur.
enum class Kernel : uint8_t {
  round,  ///< Nearly, where it is large: of eight boxes.
  box,    ///< Squares (the paper).
};

/// Which filter is as wide as a circle of confusion.
enum class LevelMatch : uint8_t {
  moments,   ///< The one whose second moment, look-up included, is the aperture's.
  diameter,  ///< The one whose side is the diameter (the paper).
};

struct LevelRequest {
  VkExtent2D extent = {1, 1};  ///< px, of the picture.
  double nearCoc = 0.0;        ///< px, ≥ 0: largest |c| of anything in front of the focal plane.
  double farCoc = 0.0;         ///< px, ≥ 0: largest |c| of anything behind it, the background included.
  int subpixelSteps = 0;       ///< s: lists have 2^s × 2^s pixels for each of the picture's.
  int mipSteps = 1;            ///< From the picture's resolution on.
  int stackSteps = -1;  ///< -1: as many as the blur asks for; of more than kMostStackSteps, the rest become mip steps.
  double border = 0.0;  ///< px: lists exist this far beyond the picture. Beyond, the border's repeat.
  double apertureMoment = 0.25;  ///< Variance of the aperture along an axis, in |c|²; 1/4 for a disc.
  LevelMatch match = LevelMatch::moments;
  Kernel kernel = Kernel::round;
  bool bilinear = true;  ///< Cells are looked up bilinearly, which widens the filter.
  bool truncate = true;  ///< Drop fragments that neither a level nor a coarser one shows.
};

/// More would make levels much larger than the picture, for the taps reach far beyond it.
inline constexpr int kMostStackSteps = 6;

struct LevelPlan {
  std::vector<shared::FilterLevel> levels;  ///< At least one.
  std::vector<shared::FilterLook> looks;    ///< At least one, the first of the picture's resolution, narrowest first.
  uint32_t listCount = 0;                   ///< Of all levels, each with one more that marks its end.
  uint32_t nearLooks = 0, farLooks = 0;     ///< Widest look that shows in front of and behind the focal plane.
};

LevelPlan planLevels(const LevelRequest& request);

}  // namespace lensgraph::passes::multilayer_filtering
