// One Embree geometry for each placed primitive, in view space. Filter functions decide about hits while the hierarchy is
// walked: faces that are not drawn and masked holes let the ray pass, and so do blended surfaces, which are noted.
#include "engine/raytracer/traced_scene.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <limits>
#include <string>
#include <tuple>
#include <type_traits>

#include "engine/error.h"

namespace lensgraph::engine {
namespace {

struct Release {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};

/// What filter functions are told of the ray: Embree hands its context on.
struct RayContext {
  RTCIntersectContext embree;  // First, so that a pointer to it points to the whole.
  const Surfaces* surfaces;
  std::vector<SurfaceHit>* blended;
};

SurfaceHit surfaceHit(const Surfaces& surfaces, const RTCHit& at, float depth, const glm::vec3& direction) {
  // Embree's normal is that of counter-clockwise corners.
  const bool isSeenClockwise = glm::dot(glm::vec3(at.Ng_x, at.Ng_y, at.Ng_z), direction) > 0.0f;
  return {.depth = depth,
          .instance = at.geomID,
          .triangle = at.primID,
          .u = at.u,
          .v = at.v,
          .facesAway = isSeenClockwise != surfaces.isMirrored(at.geomID)};
}

/// Called for one ray at a time, whose arguments have the layout of RTCRay and RTCHit.
void filterHit(const RTCFilterFunctionNArguments* arguments) {
  if (arguments->valid[0] == 0) return;
  const auto* context = reinterpret_cast<const RayContext*>(arguments->context);
  const auto* ray = reinterpret_cast<const RTCRay*>(arguments->ray);
  const auto* at = reinterpret_cast<const RTCHit*>(arguments->hit);
  const Surfaces& surfaces = *context->surfaces;
  const SurfaceHit hit = surfaceHit(surfaces, *at, ray->tfar, {ray->dir_x, ray->dir_y, ray->dir_z});
  const auto pass = [&] { arguments->valid[0] = 0; };
  if (hit.facesAway && !surfaces.drawsBothFaces(hit.instance)) return pass();
  switch (surfaces.alphaMode(hit.instance)) {
    case AlphaMode::opaque:
      return;
    case AlphaMode::mask:
      if (!surfaces.passesMask(hit)) pass();
      return;
    case AlphaMode::blend:
      if (context->blended != nullptr) context->blended->push_back(hit);
      return pass();
  }
}

bool needsFilter(const Surfaces& surfaces, uint32_t instance) {
  return surfaces.alphaMode(instance) != AlphaMode::opaque || !surfaces.drawsBothFaces(instance);
}

bool isOnEdge(const SurfaceHit& hit) {
  constexpr float kNearEdge = 1e-5f;
  return std::min({hit.u, hit.v, 1.0f - hit.u - hit.v}) < kNearEdge;
}

/// Whether two hits are one: a ray through the edge that two triangles of a surface share meets both.
bool isSameSurfacePoint(const SurfaceHit& a, const SurfaceHit& b) {
  constexpr float kEquallyFar = 1e-6f;
  if (a.instance != b.instance) return false;
  if (a.triangle == b.triangle) return true;
  return std::abs(a.depth - b.depth) <= kEquallyFar * a.depth && isOnEdge(a) && isOnEdge(b);
}

/// Farthest first, without what lies behind the opaque surface.
void arrange(std::vector<SurfaceHit>& blended, float opaqueDepth) {
  std::erase_if(blended, [&](const SurfaceHit& hit) { return !(hit.depth < opaqueDepth); });
  std::ranges::sort(blended, [](const SurfaceHit& a, const SurfaceHit& b) {
    return std::tie(b.depth, a.instance, a.triangle) < std::tie(a.depth, b.instance, b.triangle);
  });
  const auto repeated = std::ranges::unique(blended, isSameSurfacePoint);
  blended.erase(repeated.begin(), repeated.end());
}

}  // namespace

struct TracedScene::Embree {
  explicit Embree(const Surfaces& all) : surfaces(all) {}
  void require() const {
    const RTCError code = rtcGetDeviceError(device.get());
    if (code == RTC_ERROR_NONE) return;
    throw Error(code == RTC_ERROR_OUT_OF_MEMORY ? "no memory for the hierarchy of the ray tracer"
                                                : "Embree failed with code " + std::to_string(code),
                ErrorKind::failed);
  }
  void attach(uint32_t instance);

  const Surfaces& surfaces;
  std::unique_ptr<std::remove_pointer_t<RTCDevice>, Release> device;
  std::unique_ptr<std::remove_pointer_t<RTCScene>, Release> scene;
};

void TracedScene::Embree::attach(uint32_t instance) {
  const Primitive& primitive = surfaces.primitive(instance);
  if (primitive.indices.empty()) return;
  RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  const auto positions = surfaces.viewPositions(instance);
  void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3),
                                           positions.size());
  void* indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(uint32_t),
                                          primitive.triangleCount());
  if (vertices != nullptr && indices != nullptr) {
    std::memcpy(vertices, positions.data(), positions.size() * sizeof(glm::vec3));
    std::memcpy(indices, primitive.indices.data(), primitive.triangleCount() * 3 * sizeof(uint32_t));
    if (needsFilter(surfaces, instance)) rtcSetGeometryIntersectFilterFunction(geometry, filterHit);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene.get(), geometry, instance);
  }
  rtcReleaseGeometry(geometry);
  require();
}

TracedScene::TracedScene(const Surfaces& surfaces) : embree_(std::make_unique<Embree>(surfaces)) {
  embree_->device.reset(rtcNewDevice("threads=1,set_affinity=0"));
  if (embree_->device == nullptr) throw Error("Embree cannot start on this machine", ErrorKind::failed);
  embree_->scene.reset(rtcNewScene(embree_->device.get()));
  rtcSetSceneFlags(embree_->scene.get(), RTC_SCENE_FLAG_ROBUST);  // No gaps between triangles.
  for (uint32_t i = 0; i < surfaces.instanceCount(); ++i) embree_->attach(i);
  rtcCommitScene(embree_->scene.get());
  embree_->require();
}

TracedScene::~TracedScene() = default;

SurfaceHit TracedScene::trace(const ViewRay& ray, float nearDepth, std::vector<SurfaceHit>* blended) const {
  RayContext context{.embree = {}, .surfaces = &embree_->surfaces, .blended = blended};
  rtcInitIntersectContext(&context.embree);
  if (blended != nullptr) blended->clear();
  RTCRayHit query{};
  query.ray = {.org_x = ray.origin.x,
               .org_y = ray.origin.y,
               .org_z = ray.origin.z,
               .tnear = nearDepth,
               .dir_x = ray.direction.x,
               .dir_y = ray.direction.y,
               .dir_z = ray.direction.z,
               .time = 0.0f,
               .tfar = std::numeric_limits<float>::infinity(),
               .mask = ~0u,
               .id = 0,
               .flags = 0};
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(embree_->scene.get(), &context.embree, &query);
  if (blended != nullptr && !blended->empty()) arrange(*blended, query.ray.tfar);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  return surfaceHit(embree_->surfaces, query.hit, query.ray.tfar, ray.direction);
}

}  // namespace lensgraph::engine
