// The names of temporary files that a process has begun and not yet placed, in a form that a signal handler may read.
#pragma once

#include <string>

namespace lensgraph::engine {

/// Removes the temporary files of every OutputFile of the process that is not placed. Only for a process that ends
/// now: may be called in a signal handler, and the OutputFiles fail afterwards.
void removeUnfinishedFiles() noexcept;

// ---- For output_file.cpp

/// Notes a name; to be called before the file is made. Returns its slot for forgetUnfinished(), or -1 when all slots are
/// taken or the name is too long: then a signal leaves the file behind.
int noteUnfinished(const std::string& name) noexcept;
/// The file was renamed or removed. -1 is ignored.
void forgetUnfinished(int slot) noexcept;

}  // namespace lensgraph::engine
