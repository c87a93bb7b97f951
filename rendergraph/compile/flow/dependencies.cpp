// Dependencies follow from the order of the declaration calls: each cell remembers its last writer and the readers
// since. Handle versions guarantee that this order is the one the host's data flow means.
#include "rendergraph/compile/flow/dependencies.h"

#include "rendergraph/compile/flow/cells.h"
#include "rendergraph/declare/declaration.h"

namespace lensgraph::rendergraph {

Adjacency::Adjacency(std::span<const Edge> edges, uint32_t passes, By by)
    : starts_(passes + 1, 0), edges_(edges.size()) {
  const auto key = [by](const Edge& edge) { return by == By::from ? edge.from : edge.to; };
  for (const Edge& edge : edges) ++starts_[key(edge) + 1];
  for (uint32_t pass = 0; pass < passes; ++pass) starts_[pass + 1] += starts_[pass];
  std::vector<uint32_t> next(starts_.begin(), starts_.end() - 1);
  for (const Edge& edge : edges) edges_[next[key(edge)]++] = edge;
}

std::vector<Edge> dataFlow(const Declaration& declaration, const Cells& cells) {
  std::vector<Edge> edges;
  std::vector<uint32_t> writers(cells.count(), kNone);
  for (uint32_t index = 0; index < declaration.accesses.size(); ++index) {
    const DeclaredAccess& access = declaration.accesses[index];
    cells.forEach(index, [&](uint32_t cell) {
      const uint32_t writer = writers[cell];
      if (access.needsContent() && writer != kNone && writer != access.pass) {
        const Edge edge{writer, access.pass, access.resource};
        if (edges.empty() || edges.back() != edge) edges.push_back(edge);
      }
      if (access.writes()) writers[cell] = access.pass;
    });
  }
  return edges;
}

namespace {

/// Readers of each cell since its last write, as linked lists in one vector.
class Readers {
 public:
  explicit Readers(uint32_t cells) : heads_(cells, kNone) {}
  void add(uint32_t cell, uint32_t pass) {
    nodes_.push_back({pass, heads_[cell]});
    heads_[cell] = static_cast<uint32_t>(nodes_.size() - 1);
  }
  /// Calls use(pass) for every reader and forgets them.
  template <class Use>
  void take(uint32_t cell, Use&& use) {
    for (uint32_t node = heads_[cell]; node != kNone; node = nodes_[node].next) use(nodes_[node].pass);
    heads_[cell] = kNone;
  }

 private:
  struct Node {
    uint32_t pass, next;
  };
  std::vector<uint32_t> heads_;
  std::vector<Node> nodes_;
};

}  // namespace

std::vector<Edge> orderingEdges(const Declaration& declaration, const Cells& cells, std::span<const uint8_t> alive) {
  std::vector<Edge> edges;
  std::vector<uint32_t> writers(cells.count(), kNone);
  Readers readers(cells.count());
  for (uint32_t index = 0; index < declaration.accesses.size(); ++index) {
    const DeclaredAccess& access = declaration.accesses[index];
    if (!alive[access.pass]) continue;
    const auto connect = [&](uint32_t from) {
      if (from != kNone && from != access.pass) edges.push_back({from, access.pass, access.resource});
    };
    cells.forEach(index, [&](uint32_t cell) {
      connect(writers[cell]);
      if (access.writes()) {
        readers.take(cell, connect);
        writers[cell] = access.pass;
      } else {
        readers.add(cell, access.pass);
      }
    });
  }
  return edges;
}

}  // namespace lensgraph::rendergraph
