// Words for the enumerations of declarations, plans and options, as dumps, captures and errors show them.
#pragma once

#include "rendergraph/declare/declaration.h"
#include "rendergraph/execute_options.h"
#include "rendergraph/pass_kind.h"
#include "rendergraph/plan.h"
#include "rendergraph/resource.h"
#include "rendergraph/usage.h"

namespace lensgraph::rendergraph {

/// Literals: they live as long as the program.
const char* nameOf(AccessMode mode);
const char* nameOf(BarrierReason reason);
const char* nameOf(MemoryKind kind);
const char* nameOf(Origin origin);
const char* nameOf(PassKind kind);
const char* nameOf(Timing timing);
const char* nameOf(Usage usage);

}  // namespace lensgraph::rendergraph
