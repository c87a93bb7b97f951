// The coarsest division of every resource into cells that no access splits.
//
// Everything that compile() tracks (who wrote last, layout, visibility) is the same for all subresources of a cell,
// so the work depends on how finely a declaration divides its images, not on how many mips and layers they have.
// A buffer, and an image that is only used as a whole, is one cell. Image cells form a grid: aspects × mips × layers.
#pragma once

#include <cstdint>
#include <ranges>
#include <vector>

#include "rendergraph/handle.h"
#include "rendergraph/resource.h"

namespace lensgraph::rendergraph {

struct Declaration;

class Cells {
 public:
  /// The declaration outlives the cells.
  explicit Cells(const Declaration& declaration);

  /// Cells of all resources together; ids are 0 … count()-1.
  uint32_t count() const { return count_; }
  /// Ids of the cells of a resource, for range-for: aspects outermost, layers innermost.
  auto of(uint32_t resource) const {
    const Grid& grid = grids_[resource];
    return std::views::iota(grid.firstCell, grid.firstCell + grid.count());
  }

  /// Calls use(cell) for every cell of an access.
  template <class Use>
  void forEach(uint32_t access, Use&& use) const {
    const Entry& entry = entries_[access];
    if (entry.block == kNone) {
      use(entry.cell);
      return;
    }
    const Block& block = blocks_[entry.block];
    const Grid& grid = grids_[block.resource];
    for (uint32_t aspect = block.aspect.begin; aspect < block.aspect.end; ++aspect) {
      for (uint32_t mip = block.mip.begin; mip < block.mip.end; ++mip) {
        for (uint32_t layer = block.layer.begin; layer < block.layer.end; ++layer) {
          use(grid.firstCell + (aspect * grid.mips.parts + mip) * grid.layers.parts + layer);
        }
      }
    }
  }

  /// What a cell covers. Precondition: the cell belongs to the resource.
  Subresources rangeOf(uint32_t resource, uint32_t cell) const;

 private:
  /// Parts of one axis: part i goes from bounds_[first + i] to bounds_[first + i + 1].
  struct Axis {
    uint32_t first = 0, parts = 1;
  };
  struct Grid {
    uint32_t firstCell = 0;
    Axis mips, layers;
    uint32_t aspectParts = 1;
    uint32_t count() const { return aspectParts * mips.parts * layers.parts; }
  };
  struct Span {
    uint32_t begin = 0, end = 1;
  };
  struct Block {
    uint32_t resource = 0;
    Span aspect, mip, layer;
  };
  /// Nearly all accesses touch the one cell of their resource.
  struct Entry {
    uint32_t cell;
    uint32_t block;  // Index of blocks_, or kNone.
  };

  Axis divide(uint32_t total, std::vector<uint32_t>& cuts);
  Span spanOf(const Axis& axis, uint32_t first, uint32_t count) const;
  Span aspectSpan(const Grid& grid, VkImageAspectFlags aspects) const;
  Grid dividedGrid(uint32_t resource);
  void addEntry(uint32_t access);

  const Declaration& declaration_;
  uint32_t count_ = 0;
  std::vector<uint32_t> bounds_;
  std::vector<Grid> grids_;     // By resource.
  std::vector<Entry> entries_;  // By access.
  std::vector<Block> blocks_;
  std::vector<uint32_t> mipCuts_, layerCuts_;
};

}  // namespace lensgraph::rendergraph
