// Buffers that a test fills and reads: into a graph and out of it.
#pragma once

#include <cstring>
#include <span>
#include <vector>

#include "engine/vulkan/command_buffers.h"
#include "rendergraph/executor.h"
#include "rendergraph/graph.h"

namespace lensgraph::support {

/// A buffer on support::device() with this content, imported into a graph for shaders to read and write. It lives until
/// the frame has been executed.
class FilledBuffer {
 public:
  explicit FilledBuffer(std::span<const std::byte> content);
  rendergraph::Buffer importInto(rendergraph::Graph& graph, const char* name) const;

 private:
  engine::GpuBuffer buffer_;
};

/// Declares a copy of a buffer for the host to read after the frame.
rendergraph::Buffer declareReadBack(rendergraph::Graph& graph, rendergraph::Buffer buffer);

template <class T>
std::vector<T> contentOf(const rendergraph::Executor& executor, rendergraph::Buffer readBack) {
  const auto bytes = executor.mapped(readBack);
  std::vector<T> values(bytes.size() / sizeof(T));
  std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
  return values;
}

}  // namespace lensgraph::support
