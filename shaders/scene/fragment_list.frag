// SceneEmit::fragmentList and frontFragmentList: every fragment of every surface joins the list of its pixel.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "surface.glsl"
#include "half_float.glsl"
#include "fragment_list.glsl"

void main() {
  const vec4 color = surface();
  if (!(color.a > 0.0)) return;  // NaN alpha is no surface either.
  const bool isSolid = materials[materialIndex].alphaMode == kAlphaOpaque;
  appendFragment(roundedToHalf(vec4(color.rgb, min(color.a, 1.0))), gl_FragCoord.z, isSolid, !gl_FrontFacing);
}
