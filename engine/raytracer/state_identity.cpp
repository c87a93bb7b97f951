// Hashes of the large parts, and numbers of the small ones.
#include "engine/raytracer/state_identity.h"

#include <cstdio>
#include <glm/mat4x4.hpp>

namespace lensgraph::engine {
namespace {

template <class... T>
void addAll(StateHash& hash, const T&... values) {
  (hash.add(&values, sizeof values), ...);
}

void addUse(StateHash& hash, const TextureUse& use) {
  addAll(hash, use.texture, use.uvSet, use.offset, use.rotation, use.scale);
}

std::string geometryHash(const Scene& scene) {
  StateHash hash;
  for (const Primitive& p : scene.primitives) {
    hash.add(p.positions);
    hash.add(p.normals);
    hash.add(p.uvs[0]);
    hash.add(p.uvs[1]);
    hash.add(p.colors);
    hash.add(p.indices);
    addAll(hash, p.material);
  }
  for (const Instance& i : scene.instances) addAll(hash, i.primitive, i.worldFromObject);
  return hash.hex();
}

std::string materialHash(const Scene& scene) {
  StateHash hash;
  for (const Material& m : scene.materials) {
    addAll(hash, m.baseColorFactor, m.emissiveFactor, m.emissiveStrength, m.metallicFactor, m.roughnessFactor,
           m.normalScale, m.occlusionStrength, m.alphaMode, m.alphaCutoff, m.doubleSided, m.unlit);
    for (const TextureUse* use : {&m.baseColorTexture, &m.emissiveTexture, &m.metallicRoughnessTexture,
                                  &m.normalTexture, &m.occlusionTexture}) {
      addUse(hash, *use);
    }
  }
  for (const Texture& t : scene.textures) addAll(hash, t.image, t.wrapS, t.wrapT, t.magFilter);
  for (const SceneImage& i : scene.images) {
    addAll(hash, i.width, i.height, i.encoding);
    hash.add(i.rgba);
  }
  return hash.hex();
}

std::string lightHash(const Scene& scene, const Environment* environment) {
  StateHash hash;
  for (const Light& l : scene.lights) {
    const float range = l.range.value_or(0.0f);
    addAll(hash, l.type, l.color, l.intensity, range, l.innerConeAngle, l.outerConeAngle, l.worldFromLight);
  }
  if (environment != nullptr) {
    hash.add(environment->texels);
    addAll(hash, environment->desc.width, environment->desc.height, environment->irradiance);
  }
  return hash.hex();
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

void addLens(StateIdentity& identity, const RayLens& lens) {
  const auto add = [&](const char* name, double value) { identity.emplace_back(name, number(value)); };
  add("aperture radius", lens.apertureRadius);
  add("focus distance", lens.focusDistance);
  add("blade count", lens.bladeCount);
  add("blade rotation", lens.bladeRotation);
  add("blade curvature", lens.bladeCurvature);
  add("anamorphic ratio", lens.anamorphicRatio);
  add("optical vignetting", lens.opticalVignetting);
  add("spherical aberration", lens.sphericalAberration);
  add("breathing focal length", lens.breathing ? lens.breathing->focalLength : 0.0);
  add("breathing sensor height", lens.breathing ? lens.breathing->sensorHeight : 0.0);
}

}  // namespace

StateIdentity stateIdentity(const Scene& scene, const Environment* environment, const RayTracedView& view,
                            const RayTracerOptions& options) {
  StateHash camera;
  addAll(camera, view.viewpoint.viewFromWorld, view.camera.nearPlane, view.camera.fovy, view.viewpoint.metersPerUnit);
  StateIdentity identity = {
      {"size", std::to_string(view.width) + "x" + std::to_string(view.height)},
      {"pixel filter", std::string(kPixelFilterNames[static_cast<std::size_t>(options.filter)])},
      {"seed", std::to_string(options.seed)},
      {"shading", view.viewpoint.lit ? "lit" : "unlit"},
      {"faces", view.viewpoint.faces == DrawnFaces::both ? "both" : "material"},
      {"background", number(view.background[0]) + " " + number(view.background[1]) + " " + number(view.background[2])},
      {"camera", camera.hex()}};
  addLens(identity, view.lens);
  identity.emplace_back("geometry", geometryHash(scene));
  identity.emplace_back("materials", materialHash(scene));
  identity.emplace_back("lights", lightHash(scene, environment));
  return identity;
}

}  // namespace lensgraph::engine
