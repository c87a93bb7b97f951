// An environment map prepared for shading: half-float mips for the specular part, spherical harmonics for the diffuse.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

#include "engine/image/image.h"
#include "rendergraph/resource.h"

namespace lensgraph::engine {

struct Environment {
  rendergraph::ImageDesc desc;    ///< RGBA16F with a full mip chain.
  std::vector<std::byte> texels;  ///< All mips, largest first, tightly packed.
  /// Irradiance / π as nine coefficients of 1, y, z, x, xy, yz, 3z²−1, xz, x²−y² (world space), basis constants and
  /// cosine lobe folded in (Ramamoorthi & Hanrahan 2001).
  std::array<glm::vec3, 9> irradiance;
};

/// `map`: latitude-longitude, −Z in the middle, +Y up, linear RGB(A). Radiance is clamped to [0, 65504]; texels that
/// are not finite count as 0. Throws Error when the picture has no pixels or no colour.
Environment prepareEnvironment(const FloatImage& map);

}  // namespace lensgraph::engine
