// Life of a declaration's data, and the handle check that everything else relies on.
#include "rendergraph/declare/declaration.h"

#include <atomic>
#include <string>
#include <utility>

namespace lensgraph::rendergraph {

namespace {

// The only process-wide state of the library: without it, handles of two graphs could not be told apart.
uint32_t nextSerial() {
  static std::atomic<uint32_t> serial{0};
  uint32_t value = ++serial;
  while (value == 0) value = ++serial;  // 0 means "no graph".
  return value;
}

}  // namespace

Declaration::Declaration() : serial(nextSerial()) {}

Declaration::~Declaration() {
  destroyRecordings();
}

void Declaration::destroyRecordings() {
  if (!std::exchange(recordingsToDestroy, false)) return;
  for (DeclaredPass& pass : passes) {
    if (pass.destroyer != nullptr) pass.destroyer(pass.recording);
    pass.destroyer = nullptr;
  }
}

void Declaration::reset() {
  destroyRecordings();
  resources.clear();
  passes.clear();
  accesses.clear();
  problems.clear();
  inOrder = true;
  latestPass = 0;
  unfinishedPasses = 0;
  arena.reset();
  serial = nextSerial();
}

GraphError::Problem Declaration::problem(Misuse misuse, uint32_t pass, uint32_t resource, std::string reason,
                                         std::string remedy, std::source_location where) const {
  return {.misuse = misuse,
          .pass = pass < passes.size() ? std::string(passes[pass].name) : std::string(),
          .resource = resource < resources.size() ? std::string(resources[resource].name) : std::string(),
          .reason = std::move(reason),
          .remedy = std::move(remedy),
          .where = where};
}

std::vector<GraphError::Problem> Declaration::allProblems() const {
  std::vector<GraphError::Problem> all = problems;
  for (uint32_t pass = 0; unfinishedPasses != 0 && pass < passes.size(); ++pass) {
    if (!passes[pass].unfinished) continue;
    all.push_back(problem(Misuse::unfinishedPass, pass, kNone,
                          "its chain of calls has no end, so it dispatches nothing",
                          "end it with groups() or indirect()", passes[pass].where));
  }
  return all;
}

void Declaration::report(Misuse misuse, uint32_t pass, uint32_t resource, std::string reason, std::string remedy,
                         std::source_location where) {
  problems.push_back(problem(misuse, pass, resource, std::move(reason), std::move(remedy), where));
}

void Declaration::throwHandle(uint32_t resource, uint32_t graph, uint32_t pass, std::source_location where) const {
  if (resource == kNone || graph == 0) {
    throw GraphError({problem(Misuse::unknownHandle, pass, kNone, "the handle was never given a resource",
                              "use a handle that the graph returned", where)});
  }
  if (graph != serial) {
    throw GraphError({problem(Misuse::foreignHandle, pass, kNone,
                              "the handle belongs to another graph, or to this one before reset()",
                              "declare or import the resource in this graph and use that handle", where)});
  }
  throw GraphError({problem(Misuse::unknownHandle, pass, kNone,
                            "the handle's index " + std::to_string(resource) + " is past the last resource",
                            "use handles as the graph returned them", where)});
}

}  // namespace lensgraph::rendergraph
