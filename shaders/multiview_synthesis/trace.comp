// Lens rays that take the radiance of the layers as it is.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "trace.glsl"
