// Words for what a declaration consists of.
#pragma once

#include "rendergraph/declare/declaration.h"
#include "rendergraph/pass.h"

namespace lensgraph::rendergraph {

/// Literals: they live as long as the program.
const char* nameOf(PassKind kind);
const char* nameOf(Origin origin);
const char* nameOf(MemoryKind kind);

}  // namespace lensgraph::rendergraph
