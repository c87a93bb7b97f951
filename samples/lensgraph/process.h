// What the program agrees with the system before it works: signals and standard streams.
#pragma once

namespace lensgraph::cli {

/// Ended by SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE or SIGALRM, the program removes the files that it has begun and ends with the usual status,
/// 128 + the signal; a signal that the caller had ignored stays ignored. Beyond a file size limit (ulimit -f) writing
/// fails instead of ending the program. Standard streams that are closed are opened so that no other file becomes them:
/// writing to them fails.
void setUpProcess();

/// The process that gets SIGTERM when such a signal ends this one; 0: none.
void setChildToEnd(int process);

}  // namespace lensgraph::cli
