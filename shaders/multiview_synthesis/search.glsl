// Where a ray meets the surface of one layer: the vergence of the hit, or kMiss. The ray goes from the layer's near border
// to its far one; the surface is in front of the ray where its vergence is larger.

// The method of false position, then halving (Lee, Eisemann, Seidel 2009, §4.3). The ends count as what makes the first
// step fall into the middle, so most rays need no look at them. An empty texel counts as the far border: the ray goes on.
float falsePosition(uint slice, float near, float far, Ray ray) {
  float front = near, back = far;  // the surface is crossed between these
  float frontGap = far - near, backGap = near - far;  // surface minus ray at both
  bool isFound = false;
  for (uint i = 0u; i < iterations; ++i) {
    const float guess = isFound ? 0.5 * (front + back) : front + (back - front) * (frontGap / (frontGap - backGap));
    const float surface = heightAt(slice, at(ray, guess));
    if (surface >= guess) {
      isFound = true;
      back = guess;
    } else {
      front = guess;
      frontGap = max(surface, far) - guess;
    }
  }
  if (isFound) return back;
  // The ray has passed in front of all that was looked at; what lies under its far end stops it.
  return heightAt(slice, at(ray, far)) >= far ? far : kMiss;
}

// The same with depths in place of vergences, as the paper has it. A ray is no straight line there, so that a step which
// is exact on a plane in vergence is not.
float falsePositionInDepth(uint slice, float near, float far, Ray ray) {
  const float farthest = 1.0 / max(far, 1e-6);
  float front = 1.0 / near, back = farthest;
  float frontGap = back - front, backGap = front - back;
  bool isFound = false;
  for (uint i = 0u; i < iterations; ++i) {
    const float guess = isFound ? 0.5 * (front + back) : front + (back - front) * (frontGap / (frontGap - backGap));
    const float surface = heightAt(slice, at(ray, 1.0 / guess));
    const float depth = surface > 0.0 ? 1.0 / surface : 2.0 * farthest;
    if (depth <= guess) {
      isFound = true;
      back = guess;
    } else {
      front = guess;
      frontGap = min(depth, farthest) - guess;
    }
  }
  if (isFound) return 1.0 / back;
  return heightAt(slice, at(ray, far)) >= far ? far : kMiss;
}

// A look at every pixel on the way. The surface has no thickness: a ray that is behind it where it comes over it has
// passed the object's edge, and is not stopped. A find counts if the surface is also there where its height says.
float scan(uint slice, float near, float far, Ray ray) {
  const float pixelsPerVergence = length(ray.slope);
  const float steps = max(ceil((near - far) * pixelsPerVergence), 1.0);
  const float step = (near - far) / steps;
  bool wasBehind = false;  // the surface, seen from the ray, at the step before
  for (float i = 0.0; i < steps; ++i) {
    const float front = near - i * step, back = front - step;
    const float surface = heightAt(slice, at(ray, 0.5 * (front + back)));
    if (surface <= 0.0) {
      wasBehind = false;
    } else if (surface < back) {
      wasBehind = true;
    } else if (surface <= front || wasBehind || i == 0.0) {
      const float found = clamp(surface, back, front);
      const float there = heightAt(slice, at(ray, found));
      if (there > 0.0 && (wasBehind || abs(there - found) * pixelsPerVergence <= 1.0)) return found;
      wasBehind = false;
    }
  }
  return kMiss;
}

float searchLayer(uint slice, float near, float far, Ray ray) {
  if (searchKind == kSearchScan) return scan(slice, near, far, ray);
  if (searchKind == kSearchFalsePositionInDepth) return falsePositionInDepth(slice, near, far, ray);
  return falsePosition(slice, near, far, ray);
}
