// The signed circle of confusion of every pixel of a pinhole picture, from its depth: what failure masks are made of.
#pragma once

#include "engine/image/image.h"
#include "shaders/shared/lens.h"

namespace lensgraph::host {

/// c in px (a radius, negative in front of the focus), one channel, of a depth picture: one channel, metres along the
/// axis. What is not positive, NaN, or at least kNothingHit is infinitely far. `lens`: of this picture's height, as
/// passes::lensConstants() gives it; its near plane is not used. Precondition: one channel.
engine::FloatImage cocPicture(const engine::FloatImage& depth, const shared::LensConstants& lens);

}  // namespace lensgraph::host
