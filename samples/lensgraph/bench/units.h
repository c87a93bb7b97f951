// Units of time that take turns beside the variants of a benchmark, so that every time can be told as a multiple of theirs.
#pragma once

namespace lensgraph::cli {

/// Names that they have among the variants of a journal's turns.
inline constexpr const char* kPinholeUnit = "unit pinhole";
inline constexpr const char* kCopyUnit = "unit copy";
inline constexpr const char* kViewUnit = "unit accumulationView";

/// Views that a turn of kViewUnit renders; its times are of one of them.
inline constexpr int kUnitViews = 8;

}  // namespace lensgraph::cli
