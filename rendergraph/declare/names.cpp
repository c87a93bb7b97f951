// One word or phrase for each enumerator.
#include "rendergraph/declare/names.h"

namespace lensgraph::rendergraph {

const char* nameOf(AccessMode mode) {
  switch (mode) {
    case AccessMode::read:
      return "read";
    case AccessMode::write:
      return "write";
    case AccessMode::modify:
      return "modify";
  }
  return "?";
}

const char* nameOf(BarrierReason reason) {
  switch (reason) {
    case BarrierReason::readAfterWrite:
      return "read after write";
    case BarrierReason::writeAfterRead:
      return "write after read";
    case BarrierReason::writeAfterWrite:
      return "write after write";
    case BarrierReason::layout:
      return "layout";
    case BarrierReason::alias:
      return "alias";
    case BarrierReason::release:
      return "release";
    case BarrierReason::acquire:
      return "acquire";
  }
  return "?";
}

const char* nameOf(Timing timing) {
  switch (timing) {
    case Timing::none:
      return "none";
    case Timing::inlineTimestamps:
      return "inline";
    case Timing::isolated:
      return "isolated";
  }
  return "?";
}

const char* nameOf(Usage usage) {
  switch (usage) {
    case Usage::sampled:
      return "sampled";
    case Usage::storage:
      return "storage";
    case Usage::colorAttachment:
      return "color attachment";
    case Usage::depthAttachment:
      return "depth attachment";
    case Usage::depthReadOnly:
      return "read-only depth attachment";
    case Usage::transferSource:
      return "transfer source";
    case Usage::transferDestination:
      return "transfer destination";
    case Usage::uniform:
      return "uniform";
    case Usage::indirect:
      return "indirect";
    case Usage::vertex:
      return "vertex";
    case Usage::index:
      return "index";
    case Usage::host:
      return "host";
  }
  return "?";
}

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
