// Trees, ferns, grass and leaves, scattered with a fixed seed; see forest.h.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <string>
#include <vector>

#include "generate/random.h"
#include "heavy/forest.h"
#include "parts/plants.h"
#include "parts/shapes.h"

namespace scenes {
namespace {

size_t bandOf(float distance) {
  return distance < 9.0f ? 0 : distance < 20.0f ? 1 : 2;
}
/// One mesh for each band, of the same geometry.
struct Banded {
  std::array<int, kBands> mesh;
};

Banded addBanded(Glb& glb, const std::string& name, const Mesh& mesh, const ForestMaterials& materials,
                 int Band::*material, Attributes attributes) {
  Banded banded{};
  for (size_t i = 0; i < kBands; ++i) {
    banded.mesh[i] = glb.addMesh(name, mesh, materials.bands[i].*material, attributes);
  }
  return banded;
}

Mesh makeLitter(Random& random) {
  Mesh litter;
  for (int i = 0; i < 34; ++i) {
    const float size = random.between(0.05f, 0.10f);
    Mesh leaf = makeFoldedLeaf(size, size * 0.6f, random.between(0.0f, 0.18f), random.between(-0.1f, 0.25f));
    leaf = colored(
        leaf, glm::vec4(glm::mix(glm::vec3(0.62f, 0.34f, 0.10f), glm::vec3(0.40f, 0.26f, 0.12f), random.unit()), 1));
    const glm::vec3 at(random.between(-0.5f, 0.5f), random.between(0.012f, 0.04f), random.between(-0.5f, 0.5f));
    const glm::mat4 flat =
        glm::rotate(glm::translate(glm::mat4(1.0f), at), random.between(0.0f, 6.28f), glm::vec3(0, 1, 0)) *
        glm::rotate(glm::mat4(1.0f), -1.57f + random.between(-0.3f, 0.3f), glm::vec3(1, 0, 0));
    append(litter, transformed(leaf, flat));
  }
  return litter;
}

}  // namespace

void addForestTrees(Glb& glb, const ForestMaterials& materials) {
  Random random(2024);
  const std::array<TreeShape, 4> shapes = {TreeShape{.height = 9.5f,
                                                     .trunkRadius = 0.17f,
                                                     .bareShare = 0.20f,
                                                     .branches = 17,
                                                     .leaves = 13,
                                                     .leafSize = 0.18f,
                                                     .spread = 0.34f,
                                                     .leafTint = {0.46f, 0.66f, 0.22f}},
                                           TreeShape{.height = 11.0f,
                                                     .trunkRadius = 0.24f,
                                                     .bareShare = 0.26f,
                                                     .branches = 18,
                                                     .leaves = 13,
                                                     .leafSize = 0.18f,
                                                     .spread = 0.32f,
                                                     .leafTint = {0.36f, 0.56f, 0.18f}},
                                           TreeShape{.height = 8.0f,
                                                     .trunkRadius = 0.12f,
                                                     .bareShare = 0.18f,
                                                     .branches = 16,
                                                     .leaves = 13,
                                                     .leafSize = 0.18f,
                                                     .spread = 0.36f,
                                                     .leafTint = {0.62f, 0.70f, 0.24f}},
                                           TreeShape{.height = 3.2f,
                                                     .trunkRadius = 0.035f,
                                                     .bareShare = 0.1f,
                                                     .branches = 13,
                                                     .twigs = 7,
                                                     .leaves = 9,
                                                     .leafSize = 0.10f,
                                                     .spread = 0.42f,
                                                     .leafTint = {0.50f, 0.72f, 0.26f}}};
  std::vector<Banded> woods, crowns;
  for (const TreeShape& shape : shapes) {
    const Plant tree = makeTree(shape, random);
    woods.push_back(addBanded(glb, "tree", tree.wood, materials, &Band::bark, kTextured));
    crowns.push_back(addBanded(glb, "crown", tree.leaves, materials, &Band::leaf, kTinted));
  }
  std::vector<glm::vec2> taken;
  while (taken.size() < 86) {
    const float z = random.between(-44.0f, -4.2f);
    const float x = random.between(-1.0f, 1.0f) * (3.0f - 0.72f * z);
    // A glade around the stump, and a way that leads away from it.
    const float way = 0.9f * std::sin(z * 0.22f);
    if (glm::length(glm::vec2(x, z) - kStump) < 2.6f || (std::abs(x - way) < 1.3f - 0.02f * z && z > -26.0f)) continue;
    const auto tooClose = [&](glm::vec2 other) { return glm::length(other - glm::vec2(x, z)) < 1.7f; };
    if (std::ranges::any_of(taken, tooClose)) continue;
    taken.emplace_back(x, z);
    const size_t kind = z > -6.5f ? 3 : random.next() % shapes.size();
    const Placement at{.translation = {x, groundAt(x, z), z},
                       .rotation = turned(random.between(0.0f, 6.28f)),
                       .scale = random.between(0.8f, 1.2f)};
    const size_t band = bandOf(-z);
    glb.addNode("tree", woods[kind].mesh[band], at);
    glb.addNode("crown", crowns[kind].mesh[band], at);
  }
}

void addUndergrowth(Glb& glb, const ForestMaterials& materials) {
  Random random(77);
  std::vector<Banded> ferns, grasses, litters;
  for (int i = 0; i < 4; ++i) {
    const float light = i < 2 ? 1.0f : 0.42f;  // The latter two stand in the shade.
    Mesh fern = makeFern(0.66f, 10 + i % 2 * 2, 21, random);
    Mesh grass = makeGrass(0.34f, 70, random);
    shade(fern, light);
    shade(grass, light);
    ferns.push_back(addBanded(glb, "fern", fern, materials, &Band::fern, kColored));
    grasses.push_back(addBanded(glb, "grass", grass, materials, &Band::fern, kColored));
  }
  Mesh litter = makeLitter(random);
  const int sunny = glb.addMesh("litter", litter, materials.litter, kTinted);
  shade(litter, 0.4f);
  const int shady = glb.addMesh("litter", litter, materials.litter, kTinted);
  const auto scatter = [&](int count, float farthest, float power, const auto& place) {
    for (int i = 0; i < count; ++i) {
      const float z = -1.9f - (farthest - 1.9f) * std::pow(random.unit(), power);
      const float x = random.between(-1.0f, 1.0f) * (0.8f - 0.66f * z);
      const Placement at{.translation = {x, groundAt(x, z), z},
                         .rotation = turned(random.between(0.0f, 6.28f)),
                         .scale = random.between(0.7f, 1.3f)};
      place(at, sunAt(x, z) > 0.5f, bandOf(-z), random.next() % 2);
    }
  };
  scatter(170, 30.0f, 1.2f, [&](const Placement& at, bool inSun, size_t band, uint32_t kind) {
    const glm::vec2 fromStump = glm::vec2(at.translation.x, at.translation.z) - kStump;
    // The stump is to be seen.
    if (glm::length(fromStump) < 0.75f || (fromStump.y > 0.0f && std::abs(fromStump.x) < 0.7f)) return;
    glb.addNode("fern", ferns[kind + (inSun ? 0u : 2u)].mesh[band], at);
  });
  scatter(420, 22.0f, 1.6f, [&](const Placement& at, bool inSun, size_t band, uint32_t kind) {
    glb.addNode("grass", grasses[kind + (inSun ? 0u : 2u)].mesh[band], at);
  });
  scatter(150, 12.0f, 1.3f,
          [&](const Placement& at, bool inSun, size_t, uint32_t) { glb.addNode("litter", inSun ? sunny : shady, at); });
}

}  // namespace scenes
