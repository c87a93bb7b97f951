// Misuse of the graph, found before it reaches the driver.
#pragma once

#include <source_location>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace lensgraph::rendergraph {

/// What was done wrong. One name for each kind of misuse, so that hosts and tests can tell them apart.
enum class Misuse {
  unwrittenRead,     ///< A pass reads a resource that nothing has written.
  staleVersion,      ///< A handle older than the resource's last write.
  doubleWrite,       ///< One pass writes the same subresource twice.
  undeclaredAccess,  ///< A recording touches a resource that its pass did not declare.
  sizeMismatch,      ///< Attachments of one pass differ in size or layers; a copy does not fit.
  formatMismatch,    ///< Depth format as colour, colour format as depth.
  missingUsage,      ///< An imported resource lacks the usage flag that an access needs.
  cycle,             ///< Passes that wait for each other.
  unknownHandle,     ///< A default-made handle, or an index past the end.
  foreignHandle,     ///< A handle of another graph, or of this one before reset().
  overLimit,         ///< Larger than the device allows, or of size zero.
  importState,       ///< An imported or exported resource without the state that it needs.
  subresourceRange,  ///< Mips or layers outside the image.
  unfinishedPass,    ///< A ComputePass whose chain of calls has no groups() or indirect() at its end.
  unfinishedFrame,   ///< Asked for what a frame has left before it was waited for.
  outOfMemory,       ///< Device or host memory: something smaller may succeed.
  deviceLost,        ///< Nothing succeeds until device, backend and executor are made anew.
  device,            ///< The backend failed in another way.
};

/// The one exception of the graph. what() is a single line: pass, resource, reason, remedy, source location.
class GraphError : public std::runtime_error {
 public:
  struct Problem {
    Misuse misuse;
    std::string pass;            ///< Name of the pass, empty when none is concerned.
    std::string resource;        ///< Name of the resource, empty when none is concerned.
    std::string reason;          ///< What is wrong, in words.
    std::string remedy;          ///< What to do about it, in words.
    std::source_location where;  ///< Where the declaration stands in the host's code.
  };

  /// One error that reports every problem of a declaration. Precondition: problems is not empty.
  explicit GraphError(std::vector<Problem> problems);

  const std::vector<Problem>& problems() const { return problems_; }
  /// The first problem's kind.
  Misuse misuse() const { return problems_.front().misuse; }

 private:
  std::vector<Problem> problems_;
};

std::string_view nameOf(Misuse misuse);

}  // namespace lensgraph::rendergraph
