// What the prefix sum's shaders and their host code agree on.
// Source: Blelloch 1990; Sengupta, Harris, Zhang, Owens 2007 (block sums, scanned, added back).
#ifndef LENSGRAPH_SHARED_PREFIX_SUM_H
#define LENSGRAPH_SHARED_PREFIX_SUM_H

#include "shaders/shared/interop.h"

SHARED_NAMESPACE_BEGIN

SHARED_CONST uint kPrefixSumThreads = 128u;  // a work group
SHARED_CONST uint kPrefixSumRun = 8u;        // consecutive values that one invocation adds up by itself
SHARED_CONST uint kPrefixSumBlock = 1024u;   // values of a work group: threads × run

struct PrefixSumPush {
  uint first;  // of the values, index into their buffer
  uint count;
  // 1: the sum starts from the value before `first`, the end of the sums there; 0: from zero
  uint continues;
};

SHARED_NAMESPACE_END

#endif  // LENSGRAPH_SHARED_PREFIX_SUM_H
