// The sRGB curve (IEC 61966-2-1) between linear light and the encoded values of PNG files and displays.
#pragma once

namespace lensgraph::engine {

/// The encoded value of a linear one. Defined for [0,1]; below 0 and above 1 the same formula continues.
float srgbFromLinear(float linear);

/// The linear value of an encoded one; inverse of srgbFromLinear().
float linearFromSrgb(float encoded);

}  // namespace lensgraph::engine
