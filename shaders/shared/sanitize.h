// Constants of the node that replaces what is not finite (shaders/sanitize, passes/nodes/sanitize).
#ifndef LENSGRAPH_SHARED_SANITIZE_H
#define LENSGRAPH_SHARED_SANITIZE_H

#include "shaders/shared/interop.h"

SHARED_NAMESPACE_BEGIN

SHARED_CONST uint kSanitizeTile = 8u;  // px; work group side

SHARED_NAMESPACE_END

#endif  // LENSGRAPH_SHARED_SANITIZE_H
