// Words for what a declaration consists of.
#include "rendergraph/declare/names.h"

namespace lensgraph::rendergraph {

const char* nameOf(PassKind kind) {
  switch (kind) {
    case PassKind::raster:
      return "raster";
    case PassKind::compute:
      return "compute";
    case PassKind::transfer:
      return "transfer";
    case PassKind::host:
      return "host";
  }
  return "?";
}

const char* nameOf(Origin origin) {
  switch (origin) {
    case Origin::created:
      return "created";
    case Origin::imported:
      return "imported";
    case Origin::persistent:
      return "persistent";
    case Origin::historyPrevious:
      return "history previous";
    case Origin::historyNext:
      return "history next";
  }
  return "?";
}

const char* nameOf(MemoryKind kind) {
  switch (kind) {
    case MemoryKind::device:
      return "device";
    case MemoryKind::upload:
      return "upload";
    case MemoryKind::readback:
      return "readback";
  }
  return "?";
}

}  // namespace lensgraph::rendergraph
