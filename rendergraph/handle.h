// Typed, versioned names of the resources of one graph.
//
// A handle is a value: copying it costs nothing and it owns nothing. Every write to a resource returns a new
// handle with the next version (static single assignment), so a data flow reads like a program and a pass that
// uses an outdated version is found when it is declared. Handles die with the Graph that made them, or with
// Graph::reset(); using one later, or with another graph, is a GraphError.
#pragma once

#include <cstdint>

namespace lensgraph::rendergraph {

/// An index that names nothing: no pass, resource, step, submission or queue, as the field that holds it says.
inline constexpr uint32_t kNone = UINT32_MAX;

template <class Tag>
struct Handle {
  uint32_t resource = kNone;  ///< Index among the resources of the graph.
  uint32_t version = 0;            ///< Number of writes before this handle's content.
  uint32_t graph = 0;              ///< Serial number of the declaration that made it; 0 is no graph.

  /// True when the handle came from a graph at all (it may still be stale).
  explicit operator bool() const { return resource != kNone; }
  bool operator==(const Handle&) const = default;
};

using Image = Handle<struct ImageTag>;
using Buffer = Handle<struct BufferTag>;

}  // namespace lensgraph::rendergraph
