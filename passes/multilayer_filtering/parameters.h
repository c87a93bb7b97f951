// The parameters of the multi-layer filtering: every member with its unit, range and default.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "passes/multilayer_filtering/filter_levels.h"

namespace lensgraph::passes::multilayer_filtering {

/// Which fragments lists hold.
enum class Faces : uint8_t {
  outer,  ///< Both faces, but not the insides of opaque solids.
  all,    ///< Both faces.
  front,  ///< Those that face the camera (the paper).
};
inline constexpr std::array<std::string_view, 3> kFacesNames = {"outer", "all", "front"};

/// How surfaces one behind another are composited.
enum class Blend : uint8_t {
  over,      ///< As if they hid independent parts of the lens.
  additive,  ///< As if the farther lay beside the nearer until nothing is left of the lens (the paper).
};
inline constexpr std::array<std::string_view, 2> kBlendNames = {"over", "additive"};

inline constexpr std::array<std::string_view, 2> kKernelNames = {"round", "box"};
inline constexpr std::array<std::string_view, 2> kLevelMatchNames = {"moments", "diameter"};

/// Points of a pixel at which surfaces are seen.
enum class Antialiasing : uint8_t { none, points2x2, points4x4 };
inline constexpr std::array<std::string_view, 3> kAntialiasingNames = {"none", "2x2", "4x4"};

struct Parameters {
  int listLength = 4;         ///< 1…16: n, fragments of a pixel that are kept, nearest first.
  int mipSteps = 1;           ///< 0…13: a of the filter configuration a/b.
  int stackSteps = -1;        ///< -1…10: b; -1: as many as the blur asks for.
  double epsilon = 0.25;      ///< 0…4: fragments are merged while their |c| differ by less than this share of it.
  double linkDistance = 0.1;  ///< 0…4: gap up to which fragments belong to one surface, as a share of |c|.
  Blend blend = Blend::over;
  Kernel kernel = Kernel::round;
  LevelMatch levelMatch = LevelMatch::moments;
  Antialiasing antialiasing = Antialiasing::none;
  bool interpolateLevels = true;
  bool bilinear = true;
  bool truncation = true;
  Faces faces = Faces::outer;
  double border = 1.0;  ///< 0…1 of the largest blur radius: how far lists reach beyond the picture. 0 is the paper's.
};

}  // namespace lensgraph::passes::multilayer_filtering
