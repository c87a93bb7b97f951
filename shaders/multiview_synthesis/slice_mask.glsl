// A bit for each slice of the layer images: kMaxSceneLayers of them.

const uint kNoSlice = 64u;

uvec2 bitOf(uint slice) { return slice < 32u ? uvec2(1u << slice, 0u) : uvec2(0u, 1u << (slice - 32u)); }

// Takes the lowest bit out of a mask and tells its number; kNoSlice when there is none.
uint takeFirst(inout uvec2 mask) {
  if (mask.x != 0u) {
    const int bit = findLSB(mask.x);
    mask.x &= mask.x - 1u;
    return uint(bit);
  }
  if (mask.y != 0u) {
    const int bit = findLSB(mask.y);
    mask.y &= mask.y - 1u;
    return 32u + uint(bit);
  }
  return kNoSlice;
}

bool has(uvec2 mask, uint slice) { return ((slice < 32u ? mask.x >> slice : mask.y >> (slice - 32u)) & 1u) != 0u; }

// Bits 0 … count - 1.
uvec2 firstBits(uint count) {
  return uvec2(count >= 32u ? ~0u : (1u << count) - 1u, count <= 32u ? 0u : (count >= 64u ? ~0u : (1u << (count - 32u)) - 1u));
}
