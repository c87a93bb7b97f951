// What a graph owns: recordings, until reset() or its end.
#include "rendergraph/graph.h"

#include <gtest/gtest.h>

#include <utility>

namespace lensgraph {

using namespace rendergraph;

TEST(Graph, DestroysRecordingsOnResetAndAtItsEnd) {
  struct Counter {
    explicit Counter(int& living) : living(&living) { ++living; }
    Counter(const Counter& other) : living(other.living) { ++*living; }
    ~Counter() { --*living; }
    void operator()(PassContext&) const {}
    int* living;
  };
  int living = 0;
  {
    Graph graph;
    graph.addPass("a", PassKind::compute).record(Counter(living));
    EXPECT_EQ(living, 1);
    graph.reset();
    EXPECT_EQ(living, 0);
    Pass pass = graph.addPass("b", PassKind::compute);
    pass.record(Counter(living));
    pass.record(Counter(living));
    EXPECT_EQ(living, 1);
    Graph moved = std::move(graph);
    EXPECT_EQ(living, 1);
  }
  EXPECT_EQ(living, 0);
}

}  // namespace lensgraph
