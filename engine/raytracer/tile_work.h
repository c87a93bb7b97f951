// Work on the tiles of a picture by several threads.
#pragma once

#include <cstdint>
#include <functional>

namespace lensgraph::engine {

struct TileWork {
  uint32_t tiles = 0;                           ///< Tiles are numbered from 0.
  uint32_t threads = 0;                         ///< 0: one for each core.
  std::function<void(uint32_t tile)> work;      ///< Called once for each tile, from any thread.
  std::function<void(uint32_t done)> progress;  ///< Called by the calling thread, with tiles done; may be empty.
};

/// Returns when all tiles are done. The first exception of `work` or `progress` stops the others and is thrown again.
void runTiles(const TileWork& tileWork);

}  // namespace lensgraph::engine
