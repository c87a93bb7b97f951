// Must not compile: a host, or passes/, includes a header that belongs to the inside of the render graph.
// The public header above it shows that the rest of the command is right.
#include "rendergraph/graph.h"
//
#include "rendergraph/compile/sync/hazard_tracker.h"
