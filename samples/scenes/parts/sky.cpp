// A gradient in height and a lobe about the sun; see sky.h.
#include "parts/sky.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <utility>
#include <vector>

#include "generate/canvas.h"
#include "generate/mesh.h"

namespace scenes {

glm::vec3 radianceOf(const Sky& sky, glm::vec3 direction) {
  direction = glm::normalize(direction);
  const float towards = std::max(0.0f, glm::dot(direction, glm::normalize(sky.towardsSun)));
  const float lobe = 0.35f * std::pow(towards, 3.0f) + 0.65f * std::pow(towards, 24.0f);
  const float up = std::sqrt(std::max(0.0f, direction.y));
  const glm::vec3 above = glm::mix(sky.horizon, sky.zenith, up) + sky.glow * lobe;
  return glm::mix(sky.ground, above, glm::smoothstep(-0.08f, 0.02f, direction.y));
}

void writeSky(const std::filesystem::path& file, const Sky& sky) {
  constexpr int kWidth = 128;
  constexpr int kHeight = 64;
  std::vector<glm::vec3> radiance;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const float longitude = ((static_cast<float>(x) + 0.5f) / kWidth - 0.5f) * glm::two_pi<float>();
      const float polar = (static_cast<float>(y) + 0.5f) / kHeight * glm::pi<float>();
      const float ring = std::sin(polar);
      radiance.push_back(radianceOf(sky, {ring * std::sin(longitude), std::cos(polar), -ring * std::cos(longitude)}));
    }
  }
  writeExr(file, kWidth, kHeight, radiance);
}

void addSkyDome(Glb& glb, const Sky& sky, float radius) {
  Mesh dome = makeSphere(48, 64);
  std::vector<uint32_t> kept;
  for (size_t i = 0; i + 2 < dome.indices.size(); i += 3) {
    const auto heightOf = [&](size_t corner) { return dome.vertices[dome.indices[i + corner]].position.y; };
    if (std::max({heightOf(0), heightOf(1), heightOf(2)}) < -0.1f) continue;
    kept.insert(kept.end(), {dome.indices[i], dome.indices[i + 2], dome.indices[i + 1]});  // Seen from inside.
  }
  dome.indices = std::move(kept);
  for (Vertex& vertex : dome.vertices) {
    vertex.color = glm::vec4(glm::min(radianceOf(sky, vertex.position), glm::vec3(1.0f)), 1.0f);
    vertex.position *= radius;
  }
  glb.add("sky", dome, glb.addMaterial({.name = "sky"}), {.colors = true});
}

}  // namespace scenes
