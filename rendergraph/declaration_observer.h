// Somebody who follows a declaration while it is made.
#pragma once

namespace lensgraph::rendergraph {

class Graph;

/// Given to Graph::observe(). May declare passes, resources and exports in its calls; the graph does not tell it of what
/// it declares there.
class DeclarationObserver {
 public:
  virtual ~DeclarationObserver() = default;

  /// Graph::reset(): nothing is declared any more.
  virtual void declarationReset() = 0;
  /// The passes that the graph holds have been declared, the last one perhaps in part: an access may still be added to
  /// it unless `complete`.
  virtual void passesDeclared(Graph& graph, bool complete) = 0;
};

}  // namespace lensgraph::rendergraph
