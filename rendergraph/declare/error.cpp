// Words of GraphError.
#include "rendergraph/error.h"

#include <utility>

namespace lensgraph::rendergraph {

namespace {

std::string lineOf(const GraphError::Problem& problem) {
  std::string line(nameOf(problem.misuse));
  if (!problem.pass.empty()) line += ": pass '" + problem.pass + "'";
  if (!problem.resource.empty()) {
    line += problem.pass.empty() ? ": " : ", ";
    line += "resource '" + problem.resource + "'";
  }
  line += ": " + problem.reason;
  if (!problem.remedy.empty()) line += "; " + problem.remedy;
  if (problem.where.line() != 0) {
    line += " (" + std::string(problem.where.file_name()) + ":" + std::to_string(problem.where.line()) + ")";
  }
  return line;
}

std::string lineOf(const std::vector<GraphError::Problem>& problems) {
  std::string line;
  for (const GraphError::Problem& problem : problems) {
    if (!line.empty()) line += " | ";
    line += lineOf(problem);
  }
  return line;
}

}  // namespace

GraphError::GraphError(std::vector<Problem> problems)
    : std::runtime_error(lineOf(problems)), problems_(std::move(problems)) {}

std::string_view nameOf(Misuse misuse) {
  switch (misuse) {
    case Misuse::unwrittenRead:
      return "unwritten read";
    case Misuse::staleVersion:
      return "stale version";
    case Misuse::doubleWrite:
      return "double write";
    case Misuse::undeclaredAccess:
      return "undeclared access";
    case Misuse::sizeMismatch:
      return "size mismatch";
    case Misuse::formatMismatch:
      return "format mismatch";
    case Misuse::missingUsage:
      return "missing usage";
    case Misuse::cycle:
      return "cycle";
    case Misuse::unknownHandle:
      return "unknown handle";
    case Misuse::foreignHandle:
      return "foreign handle";
    case Misuse::overLimit:
      return "over limit";
    case Misuse::importState:
      return "import state";
    case Misuse::subresourceRange:
      return "subresource range";
    case Misuse::unfinishedPass:
      return "unfinished pass";
    case Misuse::unfinishedFrame:
      return "unfinished frame";
    case Misuse::outOfMemory:
      return "out of memory";
    case Misuse::deviceLost:
      return "device lost";
    case Misuse::device:
      return "device";
  }
  return "?";
}

}  // namespace lensgraph::rendergraph
