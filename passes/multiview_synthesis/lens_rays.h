// The rays through the lens, and the points of the lens from which the scene is decomposed for them.
//
// The paper decomposes once, from the lens's centre. Beyond it, several decompositions from points spread over the lens
// serve the rays that are nearest to each, and each sees through other places of the pixels: hidden surfaces come into
// view, rays travel less, edges in focus are antialiased. With as many views as rays it is the accumulation buffer.
#pragma once

#include <cstdint>
#include <vector>

#include "passes/lens/lens_samples.h"
#include "shaders/shared/multiview_synthesis.h"

namespace lensgraph::passes::multiview_synthesis {

/// How the rays of one pixel differ from those of the next.
enum class Jitter : uint8_t {
  none,    ///< Not at all.
  noise,   ///< Each lens point moves by one of 16 offsets that the pixel's four random numbers make (Lee 2009, §4.5).
  halton,  ///< Each pixel takes another run of a sequence of twice the length (Lee 2009, §4.5).
};
inline constexpr std::array<std::string_view, 3> kJitterNames = {"none", "noise", "halton"};

/// One decomposition and the rays it serves.
struct LensView {
  shared::vec2 lens = {0.0f, 0.0f};         ///< v that the scene is seen from.
  shared::vec2 pixelOffset = {0.0f, 0.0f};  ///< px
  std::vector<shared::LensRay> rays;        ///< For Jitter::halton twice as many as each pixel traces.
  uint32_t raysPerPixel = 0;
  float reach = 0.0f;  ///< Largest distance of a ray's lens point from `lens`, jitter included.
};

struct LensRayRequest {
  shared::ApertureShape aperture;
  uint32_t rayCount = 32;  ///< Of a pixel, over all views.
  uint32_t viewCount = 1;
  LensPattern pattern = LensPattern::sobol;
  Jitter jitter = Jitter::none;
};

/// Half the side of the square over which Jitter::noise moves a lens point of a set of `rayCount`, in lens radii.
float noiseReach(uint32_t rayCount);

/// Views without rays are left out.
std::vector<LensView> lensViews(const LensRayRequest& request);

}  // namespace lensgraph::passes::multiview_synthesis
