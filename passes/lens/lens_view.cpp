// Derivation, in x (y likewise with y down). A point at (x, y, z) in view space, d = -z, is at
//   p = w/2 + S x/d   px from the left in the pinhole view. From the point v of the lens, every point moves by
//     its signed CoC radius times v (Lee 2009 eq. 3, in vergence), and the pixel by its jitter j:
//   p' = p + K (V_f - 1/d) v + j.
// Clip space wants (p' - w/2)·2/w · d, which is linear in (x, z, 1):
//   x_clip = 2/w (S x + (K V_f v + j) d - K v)
#include "passes/lens/lens_view.h"

namespace lensgraph::passes {

shared::ViewConstants viewFromLens(const DofInputs& inputs, shared::vec2 v, shared::vec2 pixelOffset) {
  const double s = inputs.projection.pixelsPerTangent;
  const double k = inputs.lens.cocScale;
  const double focus = inputs.lens.focusVergence;
  const double scaleX = 2.0 / inputs.extent.width;
  const double scaleY = 2.0 / inputs.extent.height;
  shared::ViewConstants view{};
  float* m = view.clipFromView.columns;
  m[0] = static_cast<float>(scaleX * s);
  m[5] = static_cast<float>(-scaleY * s);
  m[8] = static_cast<float>(-scaleX * (k * focus * v.x + pixelOffset.x));  // times z = -d
  m[9] = static_cast<float>(-scaleY * (k * focus * v.y + pixelOffset.y));
  m[11] = -1.0f;
  m[12] = static_cast<float>(-scaleX * k * v.x);
  m[13] = static_cast<float>(-scaleY * k * v.y);
  m[14] = inputs.projection.nearPlane;
  const auto lensRadius = static_cast<float>(k / s);
  view.lensPoint = {lensRadius * v.x, -lensRadius * v.y, 0.0f, 0.0f};
  return view;
}

}  // namespace lensgraph::passes
