// Rounds of samples over all tiles of the picture; the sample itself is the mean of what one ray sees.
#include "engine/raytracer/ray_tracer.h"

#include <embree3/rtcore_config.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/raytracer/aperture.h"
#include "engine/raytracer/camera_rays.h"
#include "engine/raytracer/picture_state.h"
#include "engine/raytracer/state_identity.h"
#include "engine/raytracer/surfaces.h"
#include "engine/raytracer/tile_work.h"
#include "engine/raytracer/traced_scene.h"

namespace lensgraph::engine {
namespace {

constexpr uint32_t kTileSide = 16;        ///< px; small enough for all cores, large enough to keep caches warm.
constexpr uint32_t kSamplesPerRound = 8;  ///< A pixel; between rounds the state may be written.
constexpr uint32_t kLensStream = 1, kPixelStream = 2;
/// Small enough to vanish beside any real weight: a pixel whose samples all lie where the lens is dark is their plain mean.
constexpr double kFaintWeight = 1e-12;

/// Everything that a sample needs, for the whole picture.
struct Tracing {
  Tracing(const Scene& scene, const Environment* environment, const RayTracedView& tracedView,
          const RayTracerOptions& tracerOptions)
      : view(tracedView),
        options(tracerOptions),
        surfaces(scene, view.viewpoint, environment),
        scene(surfaces),
        rays(view),
        aperture(view.lens),
        nearDepth(static_cast<float>(view.camera.nearPlane)) {}

  const RayTracedView& view;
  const RayTracerOptions& options;
  Surfaces surfaces;
  TracedScene scene;
  CameraRays rays;
  Aperture aperture;
  float nearDepth;
};

/// Radiance along a ray: the opaque surface or the background, and over it what is blended, nearest last.
glm::vec3 radianceAlong(const Tracing& tracing, const ViewRay& ray, std::vector<SurfaceHit>& blended) {
  const SurfaceHit nearest = tracing.scene.trace(ray, tracing.nearDepth, &blended);
  const auto& background = tracing.view.background;
  glm::vec3 sum = nearest.isSomething() ? tracing.surfaces.radiance(nearest, ray)
                                        : glm::vec3(background[0], background[1], background[2]);
  for (const SurfaceHit& hit : blended) {
    const float alpha = tracing.surfaces.blendAlpha(hit);
    if (alpha > 0.0f) sum = tracing.surfaces.radiance(hit, ray) * alpha + sum * (1.0f - alpha);
  }
  return sum;
}

/// The next point of the aperture in the pixel's sequence; m, and what it counts for.
struct LensDraw {
  glm::dvec2 point{0.0};
  double weight = 1.0;
};

LensDraw drawLensPoint(const Tracing& tracing, const glm::dvec2& film, uint32_t streamOfPixel, PixelSum& sum) {
  const double radius = tracing.view.lens.apertureRadius;
  if (radius == 0.0) return {};
  const glm::dvec2 place = tracing.rays.placeOf(film);
  for (;;) {  // The center is always open, and a part of what surrounds it.
    const glm::dvec2 v = tracing.aperture.candidate(discPoint(samplePoint(sum.lensPoints++, streamOfPixel)));
    if (tracing.aperture.isOpen(v, place)) return {v * radius, tracing.aperture.weight(v)};
  }
}

void addSamples(const Tracing& tracing, uint32_t x, uint32_t y, uint32_t first, uint32_t end, PixelSum& sum,
                std::vector<SurfaceHit>& blended) {
  const uint32_t pixel = y * tracing.view.width + x;
  const uint32_t lensStream = streamSeed(pixel, tracing.options.seed, kLensStream);
  const uint32_t pixelStream = streamSeed(pixel, tracing.options.seed, kPixelStream);
  for (uint32_t i = first; i < end; ++i) {
    const glm::dvec2 film =
        glm::dvec2(x + 0.5, y + 0.5) + filterOffset(tracing.options.filter, samplePoint(i, pixelStream));
    const LensDraw lens = drawLensPoint(tracing, film, lensStream, sum);
    glm::vec3 color = radianceAlong(tracing, tracing.rays.through(film, lens.point), blended);
    if (!std::isfinite(color.r) || !std::isfinite(color.g) || !std::isfinite(color.b)) {
      color = glm::vec3(0.0f);
      ++sum.replaced;
    }
    const double weight = std::max(lens.weight, kFaintWeight);
    sum.red += weight * color.r;
    sum.green += weight * color.g;
    sum.blue += weight * color.b;
    sum.weight += weight;
  }
}

/// Calls `work` with the coordinates of every pixel of a tile.
template <class Work>
void forPixelsOfTile(uint32_t tile, uint32_t width, uint32_t height, const Work& work) {
  const uint32_t columns = (width + kTileSide - 1) / kTileSide;
  const uint32_t left = tile % columns * kTileSide, top = tile / columns * kTileSide;
  for (uint32_t y = top; y < std::min(top + kTileSide, height); ++y) {
    for (uint32_t x = left; x < std::min(left + kTileSide, width); ++x) work(x, y);
  }
}

uint32_t tileCount(const RayTracedView& view) {
  return ((view.width + kTileSide - 1) / kTileSide) * ((view.height + kTileSide - 1) / kTileSide);
}

FloatImage pinholeDepth(const Tracing& tracing) {
  FloatImage depth(tracing.view.width, tracing.view.height, 1);
  runTiles({.tiles = tileCount(tracing.view), .threads = tracing.options.threads, .work = [&](uint32_t tile) {
              forPixelsOfTile(tile, depth.width, depth.height, [&](uint32_t x, uint32_t y) {
                const ViewRay ray = tracing.rays.through({x + 0.5, y + 0.5}, {0.0, 0.0});
                const SurfaceHit hit = tracing.scene.trace(ray, tracing.nearDepth, nullptr);
                *depth.pixel(x, y) = hit.isSomething() ? hit.depth : kNoDepth;
              });
            }});
  return depth;
}

/// Adds samples until each pixel has as many as asked for. `keep` is called after each round.
template <class Keep>
void gather(const Tracing& tracing, PictureState& state, const Keep& keep) {
  const RayTracerOptions& options = tracing.options;
  const uint32_t tiles = tileCount(tracing.view), from = state.samplesDone;
  if (from >= options.samples) return;
  const uint32_t rounds = (options.samples - from + kSamplesPerRound - 1) / kSamplesPerRound;
  for (uint32_t round = 0; round < rounds; ++round) {
    const uint32_t first = state.samplesDone, end = std::min(first + kSamplesPerRound, options.samples);
    TileWork work{.tiles = tiles, .threads = options.threads, .work = {}, .progress = {}};
    work.work = [&](uint32_t tile) {
      std::vector<SurfaceHit> blended;
      forPixelsOfTile(tile, state.width, state.height, [&](uint32_t x, uint32_t y) {
        addSamples(tracing, x, y, first, end, state.pixels[std::size_t{y} * state.width + x], blended);
      });
    };
    if (options.progress)
      work.progress = [&](uint32_t done) { options.progress(round * tiles + done, rounds * tiles); };
    runTiles(work);
    state.samplesDone = end;
    keep(round + 1 == rounds);
  }
}

}  // namespace

RayTracedPicture traceRays(const Scene& scene, const Environment* environment, const RayTracedView& view,
                           const RayTracerOptions& options) {
  using Clock = std::chrono::steady_clock;
  const bool isKept = !options.checkpoint.empty();
  StateIdentity identity;
  PictureState state{.width = view.width, .height = view.height, .samplesDone = 0, .pixels = {}};
  if (isKept) {
    identity = stateIdentity(scene, environment, view, options);
    state = loadState(options.checkpoint, identity, view.width, view.height);
  } else {
    state.pixels.resize(std::size_t{view.width} * view.height);
  }
  const Tracing tracing(scene, environment, view, options);
  auto written = Clock::now();
  gather(tracing, state, [&](bool isLast) {
    if (!isKept || (!isLast && Clock::now() - written < options.checkpointInterval)) return;
    saveState(options.checkpoint, identity, state);
    written = Clock::now();
  });
  RayTracedPicture picture{.color = state.picture(), .depth = {}, .samples = state.samplesDone};
  for (const PixelSum& sum : state.pixels) picture.replacedSamples += sum.replaced;
  if (options.wantDepth) picture.depth = pinholeDepth(tracing);
  return picture;
}

const char* rayTracingLibrary() {
  return "Embree " RTC_VERSION_STRING;
}

}  // namespace lensgraph::engine
