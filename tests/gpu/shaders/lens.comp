// Evaluates lens.h and aperture.h on the device; tests/gpu/optics/lens_gpu_test.cpp compares with the same functions in C++.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lens_cases.h"

layout(local_size_x = kLensCaseGroup) in;
layout(std430, set = 0, binding = 0) readonly buffer Cases { LensCase cases[]; };
layout(std430, set = 0, binding = 1) writeonly buffer Results { LensCaseResult results[]; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i < cases.length()) results[i] = evaluateLensCase(cases[i]);
}
