// See quad_cage.h.
#include "generate/quad_cage.h"

#include <glm/geometric.hpp>
#include <map>
#include <stdexcept>
#include <utility>

namespace scenes {
namespace {

using Edge = std::pair<uint32_t, uint32_t>;

std::set<Edge> edgesOf(const QuadCage& cage) {
  std::set<Edge> edges;
  for (const auto& quad : cage.quads) {
    for (size_t i = 0; i < 4; ++i) edges.insert(std::minmax(quad[i], quad[(i + 1) % 4]));
  }
  return edges;
}

void checkClosed(const QuadCage& cage) {
  std::map<Edge, int> uses;
  for (const auto& quad : cage.quads) {
    for (size_t i = 0; i < 4; ++i) ++uses[std::minmax(quad[i], quad[(i + 1) % 4])];
  }
  for (const auto& [edge, count] : uses) {
    if (count != 2) throw std::logic_error("quad cage: an edge has " + std::to_string(count) + " faces");
  }
}

}  // namespace

void addMirrored(Cells& cells, Cell low, Cell high) {
  for (int x = low[0]; x <= high[0]; ++x) {
    for (int y = low[1]; y <= high[1]; ++y) {
      for (int z = low[2]; z <= high[2]; ++z) {
        cells.insert({x, y, z});
        cells.insert({-1 - x, y, z});
      }
    }
  }
}

QuadCage QuadCage::around(const Cells& cells) {
  QuadCage cage;
  std::map<Cell, uint32_t> corners;
  const auto corner = [&](const Cell& at) {
    const auto [found, isNew] = corners.emplace(at, static_cast<uint32_t>(cage.positions.size()));
    if (isNew) cage.positions.emplace_back(at[0], at[1], at[2]);
    return found->second;
  };
  for (const Cell& cell : cells) {
    for (size_t axis = 0; axis < 3; ++axis) {
      for (const int side : {0, 1}) {
        Cell neighbour = cell;
        neighbour[axis] += side == 0 ? -1 : 1;
        if (cells.contains(neighbour)) continue;
        Cell origin = cell;
        origin[axis] += side;
        Cell alongU = origin;
        Cell alongV = origin;
        ++alongU[(axis + 1) % 3];
        ++alongV[(axis + 2) % 3];
        Cell opposite = alongU;
        ++opposite[(axis + 2) % 3];
        if (side == 0) std::swap(alongU, alongV);
        const uint32_t a = corner(origin);
        const uint32_t b = corner(alongU);
        const uint32_t c = corner(opposite);
        const uint32_t d = corner(alongV);
        cage.quads.push_back({a, b, c, d});
      }
    }
  }
  checkClosed(cage);
  return cage;
}

void QuadCage::relax(float share, int rounds) {
  const std::set<Edge> edges = edgesOf(*this);
  for (int round = 0; round < rounds; ++round) {
    std::vector<glm::vec3> sums(positions.size(), glm::vec3(0.0f));
    std::vector<float> counts(positions.size(), 0.0f);
    for (const auto& [a, b] : edges) {
      sums[a] += positions[b];
      sums[b] += positions[a];
      counts[a] += 1.0f;
      counts[b] += 1.0f;
    }
    for (size_t i = 0; i < positions.size(); ++i) positions[i] += share * (sums[i] / counts[i] - positions[i]);
  }
}

void QuadCage::inflate(float distance) {
  const std::vector<glm::vec3> normals = vertexNormals();
  for (size_t i = 0; i < positions.size(); ++i) positions[i] += normals[i] * distance;
}

std::vector<glm::vec3> QuadCage::vertexNormals() const {
  std::vector<glm::vec3> normals(positions.size(), glm::vec3(0.0f));
  for (const auto& quad : quads) {
    const glm::vec3 areaNormal =
        glm::cross(positions[quad[2]] - positions[quad[0]], positions[quad[3]] - positions[quad[1]]);
    for (const uint32_t index : quad) normals[index] += areaNormal;
  }
  for (glm::vec3& normal : normals) normal = glm::normalize(normal);
  return normals;
}

Mesh QuadCage::triangulated() const {
  Mesh mesh;
  const std::vector<glm::vec3> normals = vertexNormals();
  for (size_t i = 0; i < positions.size(); ++i) {
    mesh.vertices.push_back({positions[i], normals[i], glm::vec2(0.0f), glm::vec4(1.0f)});
  }
  for (const auto& quad : quads) {
    mesh.indices.insert(mesh.indices.end(), {quad[0], quad[1], quad[2], quad[0], quad[2], quad[3]});
  }
  return mesh;
}

Json QuadCage::extras() {
  return {{"controlMesh",
           {{"scheme", "catmullClark"},
            {"faceVertexCount", 4},
            {"closed", true},
            {"order", "triangles 2k and 2k+1 are (a,b,c) and (a,c,d) of quad k = (a,b,c,d)"}}}};
}

}  // namespace scenes
