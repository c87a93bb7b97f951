// The blur of a point light, measured in a picture.
#pragma once

#include "engine/image/image.h"
#include "engine/scene/scene.h"
#include "samples/host/shot.h"

namespace lensgraph::support {

/// Moments of the red channel; pixel centres at +0.5.
struct Spot {
  double x = 0.0, y = 0.0;                  ///< Centroid, px.
  double varianceX = 0.0, varianceY = 0.0;  ///< px²
  double covariance = 0.0;                  ///< px²
  double radius = 0.0;                      ///< Of the uniform disc with the same second moment, px.
  double extent = 0.0;                      ///< Distance of the farthest lit pixel centre from the centroid, px.
  double flux = 0.0;                        ///< Sum over the pixels.
};

Spot measureSpot(const engine::FloatImage& picture);

/// A square white light of radiance 100 that covers `sidePx` pixels of the pinhole picture, centred at `x`,
/// `y` px from the picture's middle (y down).
engine::Scene lightScene(double depth, double sidePx, double pixelsPerTangent, double x = 0.0, double y = 0.0);

/// S of a shot, px.
double pixelsPerTangent(const host::Shot& shot);

/// Signed blur radius by the thin-lens formula, px, in double and without lens.h.
double thinLensRadius(const host::Shot& shot, double depth);

}  // namespace lensgraph::support
