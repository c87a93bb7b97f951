// Stores to half floats may truncate; rounding first keeps means true. NaN passes through: it is counted later.
vec4 roundedToHalf(vec4 value) {
  const vec4 limited = clamp(value, -65504.0, 65504.0);
  const vec4 rounded = vec4(unpackHalf2x16(packHalf2x16(limited.xy)), unpackHalf2x16(packHalf2x16(limited.zw)));
  return mix(rounded, value, isnan(value));
}
