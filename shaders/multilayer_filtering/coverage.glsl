// Fragments of one list that belong to one surface, or nearly so, summed up.
//
// A fragment covers a share of its cell and is opaque or not: alpha = coverage × opacity. Fragments of one list that
// together cover no more than the cell lie side by side, as the pieces of a slanted surface do: they add up. What goes
// beyond must lie over one another, as two panes do: it is seen through what is in front (*over*).
// Source: Selgrad 2015 §5.1 has the two cases, *over* within a list, additive across lists; coverage, which tells them
// apart after several merges, is ours. Where everything is opaque coverage is alpha.

struct Layer {
  vec3 color;      // premultiplied
  float alpha;
  float coverage;  // ≤ 1
};

const Layer kNoLayer = Layer(vec3(0.0), 0.0, 0.0);

// Puts `behind` behind what `front` holds; returns the share of it that is seen.
float addBehind(inout Layer front, Layer behind) {
  const float free = 1.0 - front.coverage;
  float seen = 1.0;
  if (behind.coverage > free) {
    const float hidden = (behind.coverage - free) / behind.coverage;
    seen = 1.0 - hidden * min(front.alpha / max(front.coverage, 1e-6), 1.0);
  }
  front.color += seen * behind.color;
  front.alpha += seen * behind.alpha;
  front.coverage = min(front.coverage + behind.coverage, 1.0);
  return seen;
}
