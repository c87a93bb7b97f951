// Walls are cut around their openings, so that reveals have depth; see facade.h.
#include "parts/facade.h"

#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <utility>
#include <vector>

#include "parts/shapes.h"
#include "parts/surface_maps.h"

namespace scenes {
namespace {

constexpr float kOpeningHalfWidth = 0.5f;  // m
constexpr float kOpeningHeight = 1.75f;    // m
constexpr float kSillHeight = 0.75f;       // m above the floor
constexpr float kReveal = 0.22f;           // m

struct Area {
  float left, right, bottom, top;
};

Mesh wallPiece(const Area& area) {
  return makeRectangle({(area.left + area.right) * 0.5f, (area.bottom + area.top) * 0.5f, 0},
                       {(area.right - area.left) * 0.5f, 0, 0}, {0, (area.top - area.bottom) * 0.5f, 0});
}

/// The wall of one bay with an opening, and the four sides of the opening.
void addPiercedWall(Mesh& mesh, const Area& wall, const Area& hole) {
  append(mesh, wallPiece({wall.left, hole.left, wall.bottom, wall.top}));
  append(mesh, wallPiece({hole.right, wall.right, wall.bottom, wall.top}));
  append(mesh, wallPiece({hole.left, hole.right, wall.bottom, hole.bottom}));
  append(mesh, wallPiece({hole.left, hole.right, hole.top, wall.top}));
  const glm::vec3 middle((hole.left + hole.right) * 0.5f, (hole.bottom + hole.top) * 0.5f, -kReveal * 0.5f);
  const glm::vec3 inward(0, 0, -kReveal * 0.5f);
  const glm::vec3 up(0, (hole.top - hole.bottom) * 0.5f, 0);
  const glm::vec3 across((hole.right - hole.left) * 0.5f, 0, 0);
  append(mesh, makeRectangle(middle - across, inward, up));
  append(mesh, makeRectangle(middle + across, -inward, up));
  append(mesh, makeRectangle(middle + up, across, -inward));
  append(mesh, makeRectangle(middle - up, across, inward));
}

Mesh makeSill() {
  const std::array<glm::vec2, 7> sill = {glm::vec2(-0.2f, 0.03f), {0.08f, 0.02f},  {0.10f, 0.0f}, {0.10f, -0.05f},
                                         {0.05f, -0.07f},         {0.04f, -0.11f}, {0.0f, -0.13f}};
  const std::array<glm::vec2, 6> lintel = {glm::vec2(0.0f, 0.34f), {0.12f, 0.31f}, {0.12f, 0.26f},
                                           {0.05f, 0.20f},         {0.05f, 0.02f}, {0.0f, 0.02f}};
  Mesh mesh = extruded(sill, 0.62f);
  append(mesh, transformed(extruded(lintel, 0.64f), glm::translate(glm::mat4(1.0f), {0, kOpeningHeight, 0})));
  mapPlanar(mesh, 0.5f);
  return mesh;
}

Mesh makeBalconySlab() {
  const std::array<glm::vec2, 6> edge = {glm::vec2(0.0f, 0.0f), {0.62f, 0.0f},   {0.64f, -0.03f},
                                         {0.64f, -0.08f},       {0.58f, -0.12f}, {0.0f, -0.14f}};
  Mesh mesh = extruded(edge, 0.95f);
  append(mesh, boxBetween({-0.949f, -0.139f, 0.0f}, {-0.93f, -0.002f, 0.6f}));
  append(mesh, boxBetween({0.93f, -0.139f, 0.0f}, {0.949f, -0.002f, 0.6f}));
  for (const float x : {-0.65f, 0.65f}) {
    const std::array<TubePoint, 5> bracket = {TubePoint{{x, -0.55f, 0.0f}, 0.03f},
                                              {{x, -0.42f, 0.06f}, 0.045f},
                                              {{x, -0.32f, 0.2f}, 0.05f},
                                              {{x, -0.2f, 0.4f}, 0.05f},
                                              {{x, -0.13f, 0.52f}, 0.04f}};
    append(mesh, makeTube(bracket, 10));
  }
  mapPlanar(mesh, 0.5f);
  return transformed(std::move(mesh), glm::translate(glm::mat4(1.0f), {0, -0.15f, 0}));
}

Mesh makeBalconyRailing() {
  const glm::mat4 lift = glm::translate(glm::mat4(1.0f), {0, -0.15f, 0.58f});
  Mesh mesh = transformed(makeRailing(1.8f, 0.95f, 14, 0), lift);
  for (const float side : {-1.0f, 1.0f}) {
    const glm::mat4 at =
        glm::rotate(glm::translate(glm::mat4(1.0f), {side * 0.9f, -0.15f, 0.3f}), glm::half_pi<float>(), {0, 1, 0});
    append(mesh, transformed(makeRailing(0.54f, 0.95f, 4, 0), at));
  }
  scaleUv(mesh, {1.0f, 3.0f});
  return mesh;
}

Mesh makeFrame() {
  Mesh mesh;
  constexpr float kBack = -kReveal;
  const auto bar = [&mesh](const Area& area, float front) {
    append(mesh, boxBetween({area.left, area.bottom, kBack}, {area.right, area.top, front}));
  };
  constexpr float kOuter = kBack + 0.07f, kInner = kBack + 0.045f;
  bar({-0.5f, -0.43f, 0.0f, kOpeningHeight}, kOuter);
  bar({0.43f, 0.5f, 0.0f, kOpeningHeight}, kOuter);
  bar({-0.43f, 0.43f, 0.0f, 0.08f}, kOuter);
  bar({-0.43f, 0.43f, kOpeningHeight - 0.07f, kOpeningHeight}, kOuter);
  bar({-0.03f, 0.03f, 0.08f, kOpeningHeight - 0.07f}, kOuter);
  for (const float y : {0.45f, 0.85f, 1.28f}) {
    bar({-0.43f, -0.03f, y, y + 0.03f}, kInner);
    bar({0.03f, 0.43f, y, y + 0.03f}, kInner);
  }
  mapPlanar(mesh, 0.6f);
  return mesh;
}

/// Two louvered leaves, opened flat against the wall.
Mesh makeShutters() {
  Mesh mesh;
  constexpr float kWidth = 0.5f;
  for (const float middle : {-0.79f, 0.79f}) {
    const float left = middle - kWidth * 0.5f, right = middle + kWidth * 0.5f;
    append(mesh, boxBetween({left, 0.0f, 0.01f}, {left + 0.05f, kOpeningHeight, 0.05f}));
    append(mesh, boxBetween({right - 0.05f, 0.0f, 0.01f}, {right, kOpeningHeight, 0.05f}));
    for (const float y : {0.0f, 0.84f, kOpeningHeight - 0.06f}) {
      append(mesh, boxBetween({left + 0.05f, y, 0.01f}, {right - 0.05f, y + 0.06f, 0.048f}));
    }
    for (int i = 0; i < 26; ++i) {
      const float y = i < 13 ? 0.09f + 0.057f * static_cast<float>(i) : 0.93f + 0.057f * static_cast<float>(i - 13);
      const glm::mat4 at = glm::rotate(glm::translate(glm::mat4(1.0f), {middle, y, 0.028f}), 0.5f, glm::vec3(1, 0, 0));
      append(mesh, transformed(makeBox({0, 0, 0}, {kWidth * 0.5f - 0.05f, 0.026f, 0.005f}), at));
    }
  }
  mapPlanar(mesh, 0.6f);
  return mesh;
}

void addCornices(Mesh& trim, float length, const House& house) {
  const std::array<glm::vec2, 6> band = {glm::vec2(0.0f, 0.12f), {0.07f, 0.10f},  {0.07f, 0.05f},
                                         {0.04f, 0.02f},         {0.04f, -0.06f}, {0.0f, -0.08f}};
  const std::array<glm::vec2, 9> crown = {glm::vec2(0.0f, 0.5f), {0.48f, 0.42f},  {0.48f, 0.32f},
                                          {0.36f, 0.24f},        {0.36f, 0.18f},  {0.18f, 0.10f},
                                          {0.12f, 0.0f},         {0.06f, -0.12f}, {0.0f, -0.14f}};
  const float top = kGroundFloorHeight + kFloorHeight * static_cast<float>(house.floors);
  const auto at = [length](float y) { return glm::translate(glm::mat4(1.0f), {length * 0.5f, y, 0.0f}); };
  append(trim, transformed(extruded(band, length * 0.5f), at(kGroundFloorHeight)));
  append(trim, transformed(extruded(crown, length * 0.5f), at(top)));
  const int dentils = static_cast<int>(length / 0.3f);
  for (int i = 0; i < dentils; ++i) {
    const float x = (static_cast<float>(i) + 0.5f) * length / static_cast<float>(dentils);
    append(trim, boxBetween({x - 0.07f, top + 0.05f, 0.0f}, {x + 0.07f, top + 0.17f, 0.3f}));
  }
  append(trim, boxBetween({0.0f, 0.0f, 0.0f}, {length, 0.35f, 0.05f}));
}

Placement within(const Placement& outer, glm::vec3 at) {
  return {.translation = outer.translation + outer.rotation * at, .rotation = outer.rotation};
}

}  // namespace

Mesh makeRailing(float width, float height, int bars, int detail) {
  Mesh mesh;
  const int sides = 6 + 2 * detail;
  const std::array<glm::vec2, 13> shape = {
      glm::vec2(0.0f, 0.03f), {0.007f, 0.03f}, {0.007f, 0.30f}, {0.012f, 0.33f}, {0.014f, 0.36f},
      {0.012f, 0.39f},        {0.007f, 0.42f}, {0.007f, 0.56f}, {0.016f, 0.60f}, {0.016f, 0.62f},
      {0.007f, 0.66f},        {0.007f, 1.0f},  {0.0f, 1.0f}};
  std::vector<glm::vec2> profile;
  for (const glm::vec2 point : shape) profile.emplace_back(point.x, point.y * height);
  const Mesh bar = makeLathe(profile, sides);
  const float step = width / static_cast<float>(bars);
  const Mesh ring = makeTorus(step * 0.44f, 0.0045f, 10 + 6 * detail, 4 + 2 * detail);
  for (int i = 0; i < bars; ++i) {
    const float x = -width * 0.5f + step * (static_cast<float>(i) + 0.5f);
    append(mesh, transformed(bar, glm::translate(glm::mat4(1.0f), {x, 0, 0})));
    if (i + 1 == bars) continue;
    for (const float y : {0.10f, 0.90f}) {
      append(mesh, transformed(ring, glm::translate(glm::mat4(1.0f), {x + step * 0.5f, y * height, 0})));
    }
  }
  for (const float share : {0.03f, 0.8f, 1.0f}) {
    const float radius = share == 1.0f ? 0.026f : 0.011f;
    const std::array<TubePoint, 2> rail = {TubePoint{{-width * 0.5f, share * height, 0}, radius},
                                           TubePoint{{width * 0.5f, share * height, 0}, radius}};
    append(mesh, makeTube(rail, sides + 2));
  }
  return mesh;
}

FacadeParts::FacadeParts(Glb& glb, const FacadeMaterials& materials)
    : glb_(glb),
      materials_(materials),
      sill_(glb.addMesh("sill and lintel", makeSill(), materials.stone, kTextured)),
      balconySlab_(glb.addMesh("balcony slab", makeBalconySlab(), materials.stone, kTextured)),
      balconyRailing_(glb.addMesh("balcony railing", makeBalconyRailing(), materials.iron, kTextured)) {
  const Mesh pane = makeRectangle({0, kOpeningHeight * 0.5f, -kReveal + 0.01f}, {kOpeningHalfWidth, 0, 0},
                                  {0, kOpeningHeight * 0.5f, 0});
  darkGlass_ = glb.addMesh("dark pane", pane, materials.darkGlass, kTextured);
  litGlass_ = glb.addMesh("lit pane", pane, materials.litGlass, kTextured);
}

int FacadeParts::addFrame(int paint) {
  return glb_.addMesh("window frame", makeFrame(), paint, kTextured);
}
int FacadeParts::addShutters(int paint) {
  return glb_.addMesh("shutters", makeShutters(), paint, kTextured);
}

void FacadeParts::placeWindow(const Placement& placement, int paintedFrame, int paintedShutters, bool lit,
                              bool shutters, bool balcony) {
  glb_.addNode("sill", sill_, placement);
  glb_.addNode("frame", paintedFrame, placement);
  glb_.addNode("pane", lit ? litGlass_ : darkGlass_, placement);
  if (shutters) glb_.addNode("shutters", paintedShutters, placement);
  if (!balcony) return;
  glb_.addNode("slab", balconySlab_, placement);
  glb_.addNode("railing", balconyRailing_, placement);
}

void addHouse(Glb& glb, FacadeParts& parts, const House& house, const Placement& placement, Random& random) {
  const float length = kBayWidth * static_cast<float>(house.bays);
  const int frame = parts.addFrame(house.paint);
  const int shutters = parts.addShutters(house.paint);
  Mesh wall;
  for (int floor = 0; floor <= house.floors; ++floor) {
    const bool ground = floor == 0;
    const float bottom = ground ? 0.0f : kGroundFloorHeight + kFloorHeight * static_cast<float>(floor - 1);
    const float top = ground ? kGroundFloorHeight : bottom + kFloorHeight;
    const float sill = ground ? 0.95f : bottom + kSillHeight;
    for (int bay = 0; bay < house.bays; ++bay) {
      const float left = kBayWidth * static_cast<float>(bay);
      const float middle = left + kBayWidth * 0.5f;
      addPiercedWall(wall, {left, left + kBayWidth, bottom, top},
                     {middle - kOpeningHalfWidth, middle + kOpeningHalfWidth, sill, sill + kOpeningHeight});
      const bool balcony = !ground && random.unit() < house.balconyShare;
      const bool lit = random.unit() < house.litShare;
      parts.placeWindow(within(placement, {middle, sill, 0.0f}), frame, shutters, lit, house.shutters && !ground,
                        balcony);
    }
  }
  mapPlanar(wall, house.metersPerTile);
  glb.addNode(house.name, glb.addMesh(house.name, wall, house.wall, kTextured), placement);
  Mesh trim;
  addCornices(trim, length, house);
  mapPlanar(trim, 0.5f);
  glb.addNode("cornices", glb.addMesh("cornices", trim, parts.materials().stone, kTextured), placement);
}

}  // namespace scenes
