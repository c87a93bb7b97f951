// The colour spaces of FLIP: linear Rec.709, the linear opponent space YCxCz, and L*a*b* with Hunt's effect.
//
// Source: Andersson et al. 2020, §3.1. All colours here are relative to the white of the display (D65): X/Xn, Y/Yn, Z/Zn.
#pragma once

namespace lensgraph::engine {

/// Tristimulus values over those of white.
struct RelativeXyz {
  float x = 0.0f, y = 0.0f, z = 0.0f;
};

/// YCxCz without its scale and offset, which no linear filter notices: Y = 116 y - 16, Cx = 500 (x - y), Cz = 200 (y - z).
struct Opponent {
  float luminance = 0.0f;   ///< y
  float redGreen = 0.0f;    ///< x - y
  float blueYellow = 0.0f;  ///< y - z
};

/// L* in 0…100; a* and b* times L*/100, since colours are less vivid where it is dark (Hunt 1952).
struct HuntLab {
  float l = 0.0f, a = 0.0f, b = 0.0f;
};

/// Of linear Rec.709.
RelativeXyz relativeXyz(float r, float g, float b);
Opponent opponentOf(const RelativeXyz& xyz);

/// L*a*b* with Hunt's effect of an opponent colour, after it is limited to what the display can show (each of R, G and B
/// in [0,1]).
HuntLab huntLab(const Opponent& color);

/// HyAB (Abasi et al. 2019): |ΔL| plus the Euclidean distance in a and b; fits large differences better than ΔE.
float hyab(const HuntLab& a, const HuntLab& b);

}  // namespace lensgraph::engine
