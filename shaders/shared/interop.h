// Makes one header readable by GLSL and by C++: the vector types and the few keywords that differ.
// Include it first in every header of shaders/shared. In C++ everything lands in namespace `lensgraph::shared`.
#ifndef LENSGRAPH_SHARED_INTEROP_H
#define LENSGRAPH_SHARED_INTEROP_H

#ifdef __cplusplus

#include <cmath>
#include <cstdint>

namespace lensgraph::shared {

// Plain vectors with GLSL's names and sizes, without arithmetic: C++ uses them to fill push constants and buffers.
struct vec2 {
  float x, y;
  bool operator==(const vec2&) const = default;
};
struct vec3 {
  float x, y, z;
  bool operator==(const vec3&) const = default;
};
struct vec4 {
  float x, y, z, w;
  bool operator==(const vec4&) const = default;
};
struct ivec2 {
  int32_t x, y;
  bool operator==(const ivec2&) const = default;
};
struct uvec2 {
  uint32_t x, y;
  bool operator==(const uvec2&) const = default;
};
struct mat4 {
  float columns[16];  ///< Column-major.
};
using uint = uint32_t;

// GLSL's functions on floats, for formulas that both languages compile.
using std::cos;
using std::floor;
using std::sin;
using std::sqrt;
inline float atan(float y, float x) { return std::atan2(y, x); }

}  // namespace lensgraph::shared

#define SHARED_NAMESPACE_BEGIN namespace lensgraph::shared {
#define SHARED_NAMESPACE_END }
#define SHARED_FUNCTION inline
#define SHARED_CONST inline constexpr

#else  // GLSL

#define SHARED_NAMESPACE_BEGIN
#define SHARED_NAMESPACE_END
#define SHARED_FUNCTION
#define SHARED_CONST const

#endif

#endif  // LENSGRAPH_SHARED_INTEROP_H
