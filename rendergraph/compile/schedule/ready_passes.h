// Counts what each pass still waits for; shared by all ways to order passes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rendergraph/compile/flow/dependencies.h"

namespace lensgraph::rendergraph {

class ReadyPasses {
 public:
  /// Backward: every edge is turned round. `edges` must outlive this.
  ReadyPasses(std::span<const Edge> edges, uint32_t passes, bool backward = false)
      : backward_(backward),
        next_(edges, passes, backward ? Adjacency::By::to : Adjacency::By::from),
        count_(passes, 0) {
    for (const Edge& edge : edges) ++count_[backward ? edge.from : edge.to];
    reset();
  }
  void reset() { open_ = count_; }
  bool ready(uint32_t pass) const { return open_[pass] == 0; }

  /// Calls use(pass) for every pass that becomes ready because this one is done.
  template <class Use>
  void finish(uint32_t pass, Use&& use) {
    forEachNext(pass, [&](uint32_t next) {
      if (--open_[next] == 0) use(next);
    });
  }
  /// Those that wait for a pass; some more than once.
  template <class Use>
  void forEachNext(uint32_t pass, Use&& use) const {
    for (const Edge& edge : next_.of(pass)) use(backward_ ? edge.from : edge.to);
  }

 private:
  bool backward_;
  Adjacency next_;
  std::vector<uint32_t> count_, open_;
};

}  // namespace lensgraph::rendergraph
