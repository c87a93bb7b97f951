// How a picture is ray-traced: what changes its noise, its filter or its course, not what it shows.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>

#include "engine/raytracer/sample_points.h"

namespace lensgraph::engine {

struct RayTracerOptions {
  uint32_t samples = 256;                 ///< Rays a pixel, at least 1. Time is proportional to it.
  PixelFilter filter = PixelFilter::box;  ///< See sample_points.h.
  uint32_t seed = 0;                      ///< Another seed is another picture of the same expectation.
  uint32_t threads = 0;                   ///< 0: one for each core. Changes no bit of the picture.
  bool wantDepth = false;                 ///< See RayTracedPicture::depth.

  /// File in which the state is kept while the picture is made and afterwards; empty: none. If it is there, it is gone on
  /// from: with a state of more samples than asked for the picture has those.
  std::filesystem::path checkpoint;
  /// Least time between two writings of the state.
  std::chrono::milliseconds checkpointInterval{10'000};

  /// Called now and then by the thread that called, with parts done of all parts. An exception from it ends the work.
  std::function<void(uint32_t done, uint32_t total)> progress;
};

}  // namespace lensgraph::engine
