// Coordinate compression of the declared ranges.
#include "rendergraph/cells.h"

#include <algorithm>

#include "rendergraph/declaration.h"

namespace rendergraph {

Cells::Cells(const Declaration& declaration) {
  const auto resources = static_cast<uint32_t>(declaration.resources.size());
  grids_.reserve(resources);
  bounds_.reserve(resources * 4);
  for (uint32_t resource = 0; resource < resources; ++resource) addGrid(declaration, resource);
  blocks_.reserve(declaration.accesses.size());
  for (const DeclaredAccess& access : declaration.accesses) {
    const Grid& grid = grids_[access.resource];
    blocks_.push_back({.resource = access.resource,
                       .aspect = aspectSpan(grid, access.range.aspects),
                       .mip = spanOf(grid.mips, access.range.firstMip, access.range.mipCount),
                       .layer = spanOf(grid.layers, access.range.firstLayer, access.range.layerCount)});
  }
}

void Cells::addGrid(const Declaration& declaration, uint32_t resource) {
  const DeclaredResource& declared = declaration.resources[resource];
  Grid grid;
  grid.firstCell = count_;
  grid.aspects = declared.aspects;
  std::vector<uint32_t> mipCuts, layerCuts;
  if (declared.isImage &&
      (declared.image.mips > 1 || declared.image.layers > 1 || (declared.aspects & (declared.aspects - 1)) != 0)) {
    for (const DeclaredAccess& access : declaration.accessesOfResource(resource)) {
      mipCuts.insert(mipCuts.end(), {access.range.firstMip, access.range.firstMip + access.range.mipCount});
      layerCuts.insert(layerCuts.end(), {access.range.firstLayer, access.range.firstLayer + access.range.layerCount});
      if (access.range.aspects != declared.aspects) grid.aspectParts = 2;  // Depth, then stencil.
    }
  }
  // A size of zero was reported; it must only not break the arithmetic.
  grid.mips = divide(declared.isImage ? std::max(1u, declared.image.mips) : 1, mipCuts);
  grid.layers = divide(declared.isImage ? std::max(1u, declared.image.layers) : 1, layerCuts);
  count_ += grid.count();
  grids_.push_back(grid);
}

Cells::Axis Cells::divide(uint32_t total, std::vector<uint32_t>& cuts) {
  const auto first = static_cast<uint32_t>(bounds_.size());
  cuts.push_back(0);
  cuts.push_back(total);
  std::sort(cuts.begin(), cuts.end());
  for (uint32_t cut : cuts) {
    if (cut > total) break;  // A range outside the image was reported and replaced; be safe all the same.
    if (bounds_.size() == first || bounds_.back() != cut) bounds_.push_back(cut);
  }
  const auto count = static_cast<uint32_t>(bounds_.size()) - first;
  return {.first = first, .parts = count > 1 ? count - 1 : 0};
}

Cells::Span Cells::spanOf(const Axis& axis, uint32_t first, uint32_t count) const {
  if (axis.parts == 1) return {0, 1};
  const auto begin = bounds_.begin() + axis.first;
  const auto end = begin + axis.parts + 1;
  const auto from = std::lower_bound(begin, end, first);
  const auto to = std::lower_bound(from, end, first + count);
  return {static_cast<uint32_t>(from - begin), static_cast<uint32_t>(to - begin)};
}

Cells::Span Cells::aspectSpan(const Grid& grid, VkImageAspectFlags aspects) const {
  if (grid.aspectParts == 1) return {0, 1};
  return {(aspects & VK_IMAGE_ASPECT_DEPTH_BIT) != 0 ? 0u : 1u, (aspects & VK_IMAGE_ASPECT_STENCIL_BIT) != 0 ? 2u : 1u};
}

Subresources Cells::rangeOf(uint32_t resource, uint32_t cell) const {
  const Grid& grid = grids_[resource];
  uint32_t index = cell - grid.firstCell;
  const uint32_t layer = index % grid.layers.parts;
  index /= grid.layers.parts;
  const uint32_t mip = index % grid.mips.parts;
  const uint32_t aspect = index / grid.mips.parts;
  const uint32_t* mips = &bounds_[grid.mips.first + mip];
  const uint32_t* layers = &bounds_[grid.layers.first + layer];
  VkImageAspectFlags aspects = grid.aspects;
  if (grid.aspectParts == 2) aspects = aspect == 0 ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_STENCIL_BIT;
  return {.firstMip = mips[0],
          .mipCount = mips[1] - mips[0],
          .firstLayer = layers[0],
          .layerCount = layers[1] - layers[0],
          .aspects = aspects};
}

}  // namespace rendergraph
