// The signed circle of confusion of every pixel of a pinhole picture, from its depth: what failure masks are made of.
#pragma once

#include "engine/image/image.h"
#include "samples/host/shot.h"
#include "shaders/shared/lens.h"

namespace lensgraph::host {

/// c in px (a radius, negative in front of the focus), one channel, of a depth picture: one channel, metres along the
/// axis. What is not positive, NaN, or at least kNothingHit is infinitely far. `lens`: of this picture's height, as
/// passes::lensConstants() gives it; its near plane is not used. Precondition: one channel.
engine::FloatImage cocPicture(const engine::FloatImage& depth, const shared::LensConstants& lens);

/// The same with the shot's lens and camera, at the depth picture's height instead of the shot's. Where the camera is one of
/// the scene's, the scene is loaded for it. Throws engine::Error.
engine::FloatImage cocPicture(const engine::FloatImage& depth, const Shot& shot);

}  // namespace lensgraph::host
