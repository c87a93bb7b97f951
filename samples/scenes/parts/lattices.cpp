// Each pattern walks the cells of its area and appends one part for each; see lattices.h.
#include "parts/lattices.h"

#include <array>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "parts/shapes.h"

namespace scenes {
namespace {

glm::mat4 at(glm::vec2 place, float z = 0.0f) {
  return glm::translate(glm::mat4(1.0f), glm::vec3(place, z));
}

/// Calls with the middle of every cell whose middle is not in the hole. cell: width and height.
void forEachCell(const LatticeArea& area, glm::vec2 cell, const std::function<void(glm::vec2)>& visit) {
  const int columns = static_cast<int>(std::ceil(area.halfSize.x / cell.x));
  const int rows = static_cast<int>(std::ceil(area.halfSize.y / cell.y));
  for (int row = -rows; row < rows; ++row) {
    for (int column = -columns; column < columns; ++column) {
      const glm::vec2 middle((static_cast<float>(column) + 0.5f) * cell.x, (static_cast<float>(row) + 0.5f) * cell.y);
      if (glm::length(middle - area.holeCenter) >= area.holeRadius) visit(middle);
    }
  }
}

}  // namespace

Mesh makeBeadCurtain(const LatticeArea& area, float coverage, Random& random) {
  Mesh curtain;
  const float diameter = coverage * area.pitch;
  const Mesh bead = makeSphere(5, 7);
  const float shift = random.between(-0.5f, 0.5f) * area.pitch;
  forEachCell(area, {area.pitch, diameter * 1.02f}, [&](glm::vec2 middle) {
    const float sway = 0.1f * area.pitch * std::sin(middle.x * 40.0f / area.pitch);
    const float size = 0.5f * diameter * random.between(0.8f, 1.0f);
    const float tone = random.between(0.6f, 1.0f);
    const glm::mat4 place = glm::scale(at({middle.x + shift, middle.y}, sway), {size, size * 0.96f, size});
    append(curtain, colored(transformed(bead, place), glm::vec4(glm::vec3(tone), 1.0f)));
  });
  return curtain;
}

Mesh makeDiagonalLattice(const LatticeArea& area, float coverage) {
  Mesh lattice;
  const float half = area.pitch * 0.5f;
  const float thickness = 0.06f * area.pitch;
  forEachCell(area, glm::vec2(area.pitch), [&](glm::vec2 middle) {
    for (const float side : {-1.0f, 1.0f}) {
      const glm::mat4 turn =
          glm::rotate(at(middle, side * (thickness + 0.002f * area.pitch)), side * glm::quarter_pi<float>(), {0, 0, 1});
      append(lattice,
             transformed(makeBox(glm::vec3(0.0f), {half * glm::root_two<float>(), coverage * half * 0.7f, thickness}),
                         turn));
    }
  });
  mapPlanar(lattice, 4.0f * area.pitch);
  return lattice;
}

Mesh makeRingScreen(const LatticeArea& area, float coverage) {
  Mesh screen;
  // A ring of radii R and r covers 4 π R r of its cell.
  const float major = 0.5f - coverage * 0.08f;
  const float minor = coverage / (4.0f * glm::pi<float>() * major);
  const Mesh ring = makeTorus(major * area.pitch, minor * area.pitch, 16, 5);
  forEachCell(area, glm::vec2(area.pitch), [&](glm::vec2 middle) { append(screen, transformed(ring, at(middle))); });
  return screen;
}

Mesh makeTurnedGrille(const LatticeArea& area, float coverage) {
  Mesh grille;
  const float p = area.pitch, r = coverage * area.pitch * 0.25f;
  const std::array<glm::vec2, 9> profile = {
      glm::vec2(r * 0.7f, -0.5f * p), {r * 0.7f, -0.40f * p}, {r * 1.3f, -0.36f * p},
      {r * 0.8f, -0.30f * p},         {r * 1.25f, 0.0f},      {r * 0.8f, 0.30f * p},
      {r * 1.3f, 0.36f * p},          {r * 0.7f, 0.40f * p},  {r * 0.7f, 0.5f * p}};
  const Mesh bar = makeLathe(profile, 6);
  const Mesh ball = makeSphere(5, 6);
  forEachCell(area, glm::vec2(p), [&](glm::vec2 middle) {
    append(grille, transformed(bar, at(middle + glm::vec2(0.5f * p, 0.0f))));
    append(grille,
           transformed(bar, glm::rotate(at(middle + glm::vec2(0.0f, 0.5f * p)), glm::half_pi<float>(), {0, 0, 1})));
    append(grille, transformed(ball, glm::scale(at(middle + glm::vec2(0.5f * p, 0.5f * p)), glm::vec3(r * 1.7f))));
  });
  scaleUv(grille, {2.0f, 1.0f});
  return grille;
}

Mesh makeBlind(const LatticeArea& area, float coverage) {
  Mesh blind;
  constexpr float kTilt = 0.7f;  // rad
  const float halfHeight = 0.5f * coverage * area.pitch / std::cos(kTilt);
  const float piece = 2.0f * area.pitch;
  forEachCell(area, {piece, area.pitch}, [&](glm::vec2 middle) {
    const glm::mat4 turn = glm::rotate(at(middle), kTilt, glm::vec3(1, 0, 0));
    append(blind, transformed(makeBox(glm::vec3(0.0f), {piece * 0.5f, halfHeight, 0.02f * area.pitch}), turn));
  });
  mapPlanar(blind, 4.0f * area.pitch);
  return blind;
}

Mesh makeHoleFrame(const LatticeArea& area, float thickness) {
  return transformed(makeTorus(area.holeRadius + 0.3f * area.pitch, thickness, 64, 12), at(area.holeCenter));
}

}  // namespace scenes
