// Lens rays through the layers, front to back (Lee, Eisemann, Seidel 2009, §4.3 to §4.5), one pixel an invocation.
//
// A ray through lens point v is straight in (x, y, vergence): p(V) = p_f - c(V) (v - v0), where v0 is the lens point that
// the layers are seen from (0 in the paper). So all of the search is done in vergence, not in depth.
#include "shaders/shared/aperture.h"
#include "shaders/shared/emit.h"
#include "shaders/shared/multiview_synthesis.h"

layout(constant_id = 0) const uint jitter = kJitterNone;
layout(constant_id = 1) const uint searchKind = kSearchFalsePosition;
layout(constant_id = 2) const uint iterations = 3u;
layout(constant_id = 3) const bool hasCones = true;
layout(constant_id = 4) const bool hasTransparency = false;
layout(constant_id = 5) const bool isCulled = true;
layout(constant_id = 6) const bool mayLeave = true;

layout(local_size_x = kMultiviewTile, local_size_y = kMultiviewTile) in;
layout(set = 0, binding = 0) uniform sampler2DArray color;
layout(set = 0, binding = 1, r32f) uniform readonly image2DArray height;
layout(std430, set = 0, binding = 2) readonly buffer Tables { SceneLayerTable tables[]; };
layout(std430, set = 0, binding = 3) readonly buffer Rays { LensRay rays[]; };
layout(std430, set = 0, binding = 4) readonly buffer Visits { uvec2 visits[]; };
layout(set = 0, binding = 5, rgba32f) uniform image2D picture;
layout(push_constant) uniform Push { TracePush push; };

// Weight of what is only there so that no pixel is empty; as in the accumulation.
const float kFaintWeight = 1e-12;
const float kMiss = -1.0;

struct Ray {
  vec2 focus;  // p_f: where it crosses the focal plane, px of the layers
  vec2 slope;  // px per 1/m: K (v - v0)
};

vec2 at(Ray ray, float vergence) { return ray.focus + (vergence - push.focusVergence) * ray.slope; }

// Vergence of a layer's surface under a place; 0 where the layer is empty.
float heightAt(uint slice, vec2 place) {
  const ivec2 texel = clamp(ivec2(floor(place)), ivec2(0), push.size - 1);
  return push.vergenceScale * imageLoad(height, ivec3(texel, int(slice))).r;
}

#include "search.glsl"
#include "slice_mask.glsl"

float coneDiameterAt(float vergence) {
  return push.coneDiameter * push.cocScale * abs(push.focusVergence - vergence);
}

// What a layer's image has under a cone: a texel, or the mean over the cone's width.
vec4 lookUp(sampler2DArray image, uint slice, vec2 place, float diameter) {
  if (hasCones && diameter > 1.0) {
    return textureLod(image, vec3(place / vec2(push.size), float(slice)), log2(diameter));
  }
  return texelFetch(image, ivec3(clamp(ivec2(floor(place)), ivec2(0), push.size - 1), int(slice)), 0);
}

#ifdef SHADED
#include "gloss.glsl"
#endif

// What a ray has gathered, and what still passes.
struct Gathered {
  vec3 radiance;
  float transmittance;
};

void meet(inout Gathered gathered, uint slice, Ray ray, float vergence) {
  const vec2 place = at(ray, vergence);
  const float diameter = coneDiameterAt(vergence);
  vec4 hit = lookUp(color, slice, place, diameter);
#ifdef SHADED
  if (slice < push.layerCount) hit.rgb += glossAt(ray, slice, place, vergence, diameter, hit.a);
#endif
  gathered.radiance += gathered.transmittance * hit.rgb;
  gathered.transmittance *= max(1.0 - hit.a, 0.0);
}

// Range of vergences in which the ray is over the layers' picture.
vec2 insideRange(Ray ray) {
  const vec2 slope = mix(vec2(1e-20), ray.slope, greaterThan(abs(ray.slope), vec2(1e-20)));
  const vec2 a = (vec2(0.5) - ray.focus) / slope;
  const vec2 b = (vec2(push.size) - 0.5 - ray.focus) / slope;
  const vec2 low = min(a, b), high = max(a, b);
  return push.focusVergence + vec2(max(low.x, low.y), min(high.x, high.y));
}

// The mask of layers in which either kind of slice is to be visited. Transparent ones follow the opaque, at most 32 each.
uvec2 layersOf(uvec2 slices) {
  if (!hasTransparency) return slices;
  const uint count = push.layerCount;
  const uint transparent = count == 32u ? slices.y : (slices.x >> count) | (count == 0u ? 0u : slices.y << (32u - count));
  return (slices | uvec2(transparent, 0u)) & firstBits(count);
}

// True when the ray left the picture before it was stopped: what it would have met is not known.
bool traceRay(Ray ray, uvec2 slices, out Gathered gathered) {
  gathered = Gathered(vec3(0.0), 1.0);
  const vec2 inside = mayLeave ? insideRange(ray) : vec2(0.0, 1e30);
  if (tables[push.table].layers[0].borders.x > inside.y) return true;
  uvec2 remaining = layersOf(slices);
  for (uint l = takeFirst(remaining); l != kNoSlice; l = takeFirst(remaining)) {
    const vec2 borders = tables[push.table].layers[l].borders;
    const float near = borders.x, far = borders.y;
    if (far < inside.x) return true;
    const float opaqueHit = has(slices, l) ? searchLayer(l, near, far, ray) : kMiss;
    float clearHit = kMiss;
    const uint clearSlice = push.layerCount + l;
    if (hasTransparency && has(slices, clearSlice)) clearHit = searchLayer(clearSlice, near, far, ray);
    if (clearHit != kMiss && clearHit >= opaqueHit) meet(gathered, clearSlice, ray, clearHit);
    if (opaqueHit != kMiss) meet(gathered, l, ray, opaqueHit);
    if (gathered.transmittance <= 0.0) return false;
    if (clearHit != kMiss && clearHit < opaqueHit) meet(gathered, clearSlice, ray, clearHit);
  }
  if (inside.x > 0.0) return true;
  gathered.radiance += gathered.transmittance * push.background;
  gathered.transmittance = 0.0;
  return false;
}

// Four random numbers of a pixel in [-1, 1) (Jarzynski & Olano 2020, pcg4d). They cancel, and so do their 16 pairs: over
// all rays of a pixel the lens stays where it is.
vec4 noiseAt(uvec2 pixel) {
  uvec4 v = uvec4(pixel, 1u, 2u) * 1664525u + 1013904223u;
  v += v.yzxy * v.wxyz;
  v ^= v >> 16u;
  v += v.yzxy * v.wxyz;
  const vec2 numbers = vec2(v.xy >> 8u) * (2.0 / 16777216.0) - 1.0;
  return vec4(numbers, -numbers);
}

// The lens point of ray i, seen from the view's.
vec2 lensOffset(uint i, uint start, vec4 noise, out LensRay chosen) {
  uint index = i;
  if (jitter == kJitterHalton) {  // The run goes around the end; both terms are below the total.
    index += start;
    if (index >= push.rayTotal) index -= push.rayTotal;
  }
  chosen = rays[push.rayBase + index];
  vec2 lens = chosen.lens;
  // 16 pairs of the four numbers, dealt out to the rays.
  if (jitter == kJitterNoise) lens += push.noiseReach * vec2(noise[i & 3u], noise[(i >> 2u) & 3u]);
  chosen.lens = lens;
  return lens - push.viewPoint;
}

// What the pixel's own texel shows: the answer when every ray was lost.
vec3 pinholeColor(vec2 place) {
  Gathered gathered;
  traceRay(Ray(place, vec2(0.0)), firstBits(push.layerCount * (hasTransparency ? 2u : 1u)), gathered);
  return gathered.radiance;
}

void main() {
  const uvec2 pixel = gl_GlobalInvocationID.xy;
  if (any(greaterThanEqual(pixel, push.extent))) return;
  const ivec2 texel = ivec2(pixel) + push.border;
  uvec2 slices = firstBits(push.layerCount * (hasTransparency ? 2u : 1u));
  if (isCulled) {
    const ivec2 cell = texel / int(kMultiviewCell);
    slices &= visits[cell.y * (push.size.x / int(kMultiviewCell)) + cell.x];
  }
  const vec2 fromCentre = vec2(pixel) + 0.5 - 0.5 * vec2(push.extent);
  const vec2 place = fromCentre / (0.5 * length(vec2(push.extent)));
  const vec4 noise = noiseAt(pixel);
  const uint start = min(uint((0.5 * noise.x + 0.5) * float(push.rayTotal)), push.rayTotal - 1u);

  vec4 sum = (push.flags & kTraceFirst) != 0u ? vec4(0.0) : imageLoad(picture, ivec2(pixel));
  Ray ray;
  ray.focus = vec2(texel) + 0.5;
  for (uint i = push.firstRay; i < push.firstRay + push.rayCount; ++i) {
    LensRay chosen;
    ray.slope = push.cocScale * lensOffset(i, start, noise, chosen);
    const float weight = max(chosen.weight * apertureVignette(push.aperture, chosen.lens, place), kFaintWeight);
    Gathered gathered;
    traceRay(ray, slices, gathered);
    // A ray that left keeps what it had gathered, and counts for as much.
    sum += weight * vec4(gathered.radiance, 1.0 - gathered.transmittance);
  }
  if ((push.flags & kTraceLast) != 0u) {
    if (!(sum.a > 0.0)) sum = vec4(pinholeColor(ray.focus), 1.0);
    sum = vec4(sum.rgb / sum.a, 1.0);
  }
  imageStore(picture, ivec2(pixel), sum);
}
