// What template_technique's shader and its host code agree on: tile size, push constants.
#ifndef LENSGRAPH_SHARED_TEMPLATE_TECHNIQUE_H
#define LENSGRAPH_SHARED_TEMPLATE_TECHNIQUE_H

#include "shaders/shared/interop.h"
#include "shaders/shared/lens.h"

SHARED_NAMESPACE_BEGIN

SHARED_CONST uint kTemplateTechniqueTile = 8;  // px; side of a work group

// Vectors first: GLSL aligns them to 8 bytes, C++ to 4.
struct TemplateTechniquePush {
  ivec2 size;          // px
  LensConstants lens;
  uint samples;        // taps over the blur's disc
};

SHARED_NAMESPACE_END

#endif  // LENSGRAPH_SHARED_TEMPLATE_TECHNIQUE_H
