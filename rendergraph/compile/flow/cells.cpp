// Coordinate compression of the declared ranges.
#include "rendergraph/compile/flow/cells.h"

#include <algorithm>

#include "rendergraph/declare/declaration.h"

namespace lensgraph::rendergraph {

Cells::Cells(const Declaration& declaration) : declaration_(declaration) {
  const auto resources = static_cast<uint32_t>(declaration.resources.size());
  const auto accesses = static_cast<uint32_t>(declaration.accesses.size());
  grids_.reserve(resources);
  for (uint32_t resource = 0; resource < resources; ++resource) {
    const DeclaredResource& declared = declaration.resources[resource];
    const bool divisible = declared.isImage && (declared.image.mips > 1 || declared.image.layers > 1 ||
                                                (declared.aspects & (declared.aspects - 1)) != 0);
    Grid grid = divisible ? dividedGrid(resource) : Grid{};
    grid.firstCell = count_;
    count_ += grid.count();
    grids_.push_back(grid);
  }
  entries_.resize(accesses);
  for (uint32_t access = 0; access < accesses; ++access) addEntry(access);
}

void Cells::addEntry(uint32_t access) {
  const DeclaredAccess& declared = declaration_.accesses[access];
  const Grid& grid = grids_[declared.resource];
  if (grid.count() == 1) {
    entries_[access] = {grid.firstCell, kNone};
    return;
  }
  entries_[access] = {grid.firstCell, static_cast<uint32_t>(blocks_.size())};
  blocks_.push_back({.resource = declared.resource,
                     .aspect = aspectSpan(grid, declared.range.aspects),
                     .mip = spanOf(grid.mips, declared.range.firstMip, declared.range.mipCount),
                     .layer = spanOf(grid.layers, declared.range.firstLayer, declared.range.layerCount)});
}

Cells::Grid Cells::dividedGrid(uint32_t resource) {
  const DeclaredResource& declared = declaration_.resources[resource];
  Grid grid;
  mipCuts_.clear();
  layerCuts_.clear();
  for (const DeclaredAccess& access : declaration_.accessesOfResource(resource)) {
    mipCuts_.insert(mipCuts_.end(), {access.range.firstMip, access.range.firstMip + access.range.mipCount});
    layerCuts_.insert(layerCuts_.end(), {access.range.firstLayer, access.range.firstLayer + access.range.layerCount});
    if (access.range.aspects != declared.aspects) grid.aspectParts = 2;  // Depth, then stencil.
  }
  // A size of zero was reported; it must only not break the arithmetic.
  grid.mips = divide(std::max(1u, declared.image.mips), mipCuts_);
  grid.layers = divide(std::max(1u, declared.image.layers), layerCuts_);
  return grid;
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
  const DeclaredResource& declared = declaration_.resources[resource];
  Subresources range{.firstMip = 0, .mipCount = 1, .firstLayer = 0, .layerCount = 1, .aspects = declared.aspects};
  if (!declared.isImage) return range;
  range.mipCount = declared.image.mips;
  range.layerCount = declared.image.layers;
  if (grid.count() == 1) return range;
  uint32_t index = cell - grid.firstCell;
  const uint32_t layer = index % grid.layers.parts;
  index /= grid.layers.parts;
  const uint32_t mip = index % grid.mips.parts;
  const uint32_t aspect = index / grid.mips.parts;
  const uint32_t* mips = &bounds_[grid.mips.first + mip];
  const uint32_t* layers = &bounds_[grid.layers.first + layer];
  range.firstMip = mips[0];
  range.mipCount = mips[1] - mips[0];
  range.firstLayer = layers[0];
  range.layerCount = layers[1] - layers[0];
  if (grid.aspectParts == 2) range.aspects = aspect == 0 ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_STENCIL_BIT;
  return range;
}

}  // namespace lensgraph::rendergraph
