// The parameters of the multiview synthesis: every member with its unit, range and default.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "passes/lens/lens_samples.h"
#include "passes/multiview_synthesis/lens_rays.h"

namespace lensgraph::passes::multiview_synthesis {

/// How a ray finds the surface of a layer.
enum class Search : uint8_t {
  falsePosition,  ///< Secant steps, then halving (Lee 2009, §4.3): `iterations` looks at the surface, one more at most.
  falsePositionInDepth,  ///< The same in depth instead of vergence, as the paper has it; to compare.
  scan,                  ///< A look at every pixel on the ray's way, and one where the surface should be.
};
inline constexpr std::array<std::string_view, 3> kSearchNames = {"falsePosition", "falsePositionInDepth", "scan"};

struct Parameters {
  int lensSamples = 32;  ///< 1…4096 rays a pixel.
  double delta = 3.0;    ///< 0.25…64 px, δ: most that a ray travels in one layer. Halving it doubles the layers.
  int layers = 0;        ///< 0…64; 0: as many as δ asks for.
  int iterations = 3;    ///< 1…8 looks of the false position at a layer's surface.
  Search search = Search::scan;
  double coneWidth = 1.0;  ///< 0…8 times the paper's cone, whose diameter is 0.137·√(32/N) of |c|; 0 traces lines.
  Jitter jitter = Jitter::halton;
  int views = 1;  ///< 1…64 decompositions from points of the lens; 1, the paper's, is from its centre.
  double border =
      1.0;  ///< 0…1 of the largest blur radius: how far the layers reach beyond the picture. 0 is the paper's.
  bool splitTriangles =
      true;  ///< Triangles into every layer they cross; false: into their farthest vertex's (the paper).
  bool viewDependent = false;  ///< Shade hits as seen from their ray's lens point; needs splitTriangles.
  bool culling = true;         ///< Leave out layers that no ray of a cell can hit; changes no picture.
  LensPattern pattern = LensPattern::sobol;
};

}  // namespace lensgraph::passes::multiview_synthesis
