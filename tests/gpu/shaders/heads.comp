// Copies a buffer of list heads into the image that holds them; for tests that make lists on the host.
#version 460

layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer Values { uint values[]; };
layout(set = 0, binding = 1, r32ui) writeonly uniform uimage2D heads;

void main() {
  const int i = int(gl_GlobalInvocationID.x), width = imageSize(heads).x;
  if (i < values.length()) imageStore(heads, ivec2(i % width, i / width), uvec4(values[i]));
}
