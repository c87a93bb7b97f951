// compile(): declaration in, plan out. A pure function: no Vulkan objects, no clock, no global state.
#pragma once

#include <cstdint>

#include "rendergraph/compile_options.h"
#include "rendergraph/device_facts.h"
#include "rendergraph/plan.h"

namespace lensgraph::rendergraph {

struct Declaration;

/// Throws GraphError with every problem found. The declaration is not changed.
Plan compile(const Declaration& declaration, const CompileOptions& options, const DeviceFacts& device);

/// Hash over every field of the declaration that the plan depends on (not names, recordings, clear values or
/// the imported Vulkan objects).
uint64_t structuralHash(const Declaration& declaration, const CompileOptions& options);

}  // namespace lensgraph::rendergraph
