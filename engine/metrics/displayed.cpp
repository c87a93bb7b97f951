// The displayed picture: see displayed.h.
#include "engine/metrics/displayed.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "engine/image/srgb.h"

namespace lensgraph::engine {
namespace {

float displayedSample(float sample, double gain) {
  const double exposed = sample * gain;
  // The comparison is written so that NaN becomes 0: what a display would show.
  const double clamped = exposed > 0.0 ? std::min(exposed, 1.0) : 0.0;
  return srgbFromLinear(static_cast<float>(clamped));
}

}  // namespace

FloatImage displayed(const FloatImage& image, double exposureEv) {
  const double gain = std::exp2(exposureEv);
  const uint32_t channels = image.channels >= 3 ? 3 : 1;
  FloatImage result(image.width, image.height, channels);
  for (size_t i = 0; i < image.pixelCount(); ++i) {
    for (uint32_t c = 0; c < channels; ++c) {
      result.samples[i * channels + c] = displayedSample(image.samples[i * image.channels + c], gain);
    }
  }
  return result;
}

void displayRow(const FloatImage& image, double exposureEv, uint32_t row, std::span<float> rgb) {
  assert(rgb.size() == size_t{3} * image.width);
  const double gain = std::exp2(exposureEv);
  const float* source = image.samples.data() + size_t{row} * image.width * image.channels;
  for (size_t x = 0; x < image.width; ++x, source += image.channels) {
    float* target = rgb.data() + 3 * x;
    target[0] = displayedSample(source[0], gain);
    if (image.channels == 1) {
      target[1] = target[2] = target[0];
    } else {
      target[1] = displayedSample(source[1], gain);
      target[2] = displayedSample(source[2], gain);
    }
  }
}

}  // namespace lensgraph::engine
