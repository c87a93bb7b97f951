// House fronts: walls with openings, and the windows, shutters and balconies that are placed in them many times.
#pragma once

#include <glm/vec3.hpp>
#include <string>

#include "generate/glb.h"
#include "generate/random.h"

namespace scenes {

/// Materials, by the index that Glb gave them.
struct FacadeMaterials {
  int stone = -1;      ///< Sills, lintels, cornices, slabs of balconies.
  int iron = -1;       ///< Railings.
  int darkGlass = -1;  ///< Windows by day.
  int litGlass = -1;   ///< Windows with a lamp behind.
};

/// One storey's module. The parts stand around the middle of an opening's lower edge, z = 0 in the plane of the wall.
class FacadeParts {
 public:
  FacadeParts(Glb& glb, const FacadeMaterials& materials);

  /// paint: material of frame and shutters.
  void placeWindow(const Placement& placement, int paintedFrame, int paintedShutters, bool lit, bool shutters,
                   bool balcony);
  /// Meshes of a frame and of a pair of shutters in a paint; placeWindow() takes their indices.
  int addFrame(int paint);
  int addShutters(int paint);

  const FacadeMaterials& materials() const { return materials_; }

 private:
  Glb& glb_;
  FacadeMaterials materials_;
  int sill_, darkGlass_, litGlass_, balconySlab_, balconyRailing_;
};

struct House {
  std::string name;
  int wall = -1;  ///< Material.
  float metersPerTile = 1.0f;
  int paint = -1;  ///< Material of frames and shutters.
  int bays = 3;
  int floors = 4;  ///< Above the ground floor.
  float balconyShare = 0.3f;
  bool shutters = true;
  float litShare = 0.3f;
};

constexpr float kBayWidth = 2.4f;           // m
constexpr float kFloorHeight = 3.1f;        // m
constexpr float kGroundFloorHeight = 3.6f;  // m

/// A front of bays · kBayWidth, its lower left corner (seen from outside) at the placement's origin, outside +Z.
void addHouse(Glb& glb, FacadeParts& parts, const House& house, const Placement& placement, Random& random);

/// A wrought railing of `width` along X about the origin, `height` above y = 0: bars, rings between them, two rails.
/// detail: bars have 6 + 2 detail sides.
Mesh makeRailing(float width, float height, int bars, int detail);

}  // namespace scenes
