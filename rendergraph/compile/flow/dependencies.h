// Which pass must come before which, and whose content it needs. Pure functions of a declaration.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace lensgraph::rendergraph {

struct Declaration;
class Cells;

struct Edge {
  uint32_t from = 0;  ///< Pass that comes first.
  uint32_t to = 0;
  uint32_t resource = 0;  ///< Because of this one.
  bool operator==(const Edge&) const = default;
};

/// Edges grouped by one end.
class Adjacency {
 public:
  enum class By { from, to };
  Adjacency(std::span<const Edge> edges, uint32_t passes, By by);
  std::span<const Edge> of(uint32_t pass) const {
    return {edges_.data() + starts_[pass], edges_.data() + starts_[pass + 1]};
  }

 private:
  std::vector<uint32_t> starts_;
  std::vector<Edge> edges_;
};

/// From the producer of content to the passes that read it.
std::vector<Edge> dataFlow(const Declaration& declaration, const Cells& cells);

/// Why pass order matters: read after write, write after read, write after write; among the living passes only.
/// May name the same pair more than once.
std::vector<Edge> orderingEdges(const Declaration& declaration, const Cells& cells, std::span<const uint8_t> alive);

}  // namespace lensgraph::rendergraph
