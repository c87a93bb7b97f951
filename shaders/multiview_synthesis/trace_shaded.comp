// Lens rays that shade what they hit as seen from their lens point.
#version 460
#extension GL_GOOGLE_include_directive : require
#define SHADED
#include "trace.glsl"
