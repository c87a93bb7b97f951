// SceneEmit::fragmentList and frontFragmentList: every fragment of every surface joins the list of its pixel.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "surface.glsl"
#include "half_float.glsl"
#include "fragment_list.glsl"

layout(constant_id = 0) const bool frontOnly = false;

layout(location = 5) flat in uint isMirrored;
layout(location = 6) flat in uint bothFaces;

void main() {
  const bool facesAway = gl_FrontFacing == (isMirrored != 0u);
  if (frontOnly && facesAway) return;
  const vec4 color = surface();
  if (!(color.a > 0.0)) return;  // NaN alpha is no surface either.
  // A front whose back is never drawn opens nothing that a back would close.
  const bool isSolid = bothFaces != 0u && materials[materialIndex].alphaMode == kAlphaOpaque;
  appendFragment(roundedToHalf(vec4(color.rgb, min(color.a, 1.0))), gl_FragCoord.z, isSolid, facesAway);
}
