// Liveness from the observable ends backwards, as a compiler removes dead code, and the reasons for what is left out.
#include "rendergraph/compile/flow/culling.h"

#include <algorithm>
#include <string>

#include "rendergraph/compile/flow/cells.h"
#include "rendergraph/compile/flow/dependencies.h"
#include "rendergraph/declare/declaration.h"

namespace lensgraph::rendergraph {

namespace {

/// Cells whose content somebody later needs.
class Needs {
 public:
  Needs(const Declaration& declaration, const Cells& cells)
      : declaration_(declaration), cells_(cells), needed_(cells.count(), 0) {
    for (uint32_t resource = 0; resource < declaration.resources.size(); ++resource) {
      if (!declaration.resources[resource].exported) continue;
      for (uint32_t cell : cells.of(resource)) needed_[cell] = 1;
    }
  }

  /// Whether somebody after the pass needs what it does.
  bool wants(uint32_t pass) const {
    const DeclaredPass& declared = declaration_.passes[pass];
    if (declared.sideEffect && !declared.disabled) return true;
    for (const DeclaredAccess& access : declaration_.accessesOfPass(pass)) {
      if (!access.writes()) continue;
      if (!declaration_.resources[access.resource].created()) return true;
      bool any = false;
      cells_.forEach(declaration_.numberOf(access), [&](uint32_t cell) { any = any || needed_[cell]; });
      if (any) return true;
    }
    return false;
  }

  /// Steps before the pass: what it replaces is needed no more, what it reads is.
  void stepBefore(uint32_t pass) {
    set(
        pass, [](const DeclaredAccess& access) { return !access.needsContent(); }, 0);
    set(
        pass, [](const DeclaredAccess& access) { return access.needsContent(); }, 1);
  }

 private:
  template <class Which>
  void set(uint32_t pass, Which&& which, uint8_t value) {
    for (const DeclaredAccess& access : declaration_.accessesOfPass(pass)) {
      if (!which(access)) continue;
      cells_.forEach(declaration_.numberOf(access), [&](uint32_t cell) { needed_[cell] = value; });
    }
  }

  const Declaration& declaration_;
  const Cells& cells_;
  std::vector<uint8_t> needed_;
};

std::string reasonFor(const Declaration& declaration, uint32_t pass, std::span<const Edge> consumers) {
  if (declaration.passes[pass].disabled) return "its condition is false";
  std::string reason;
  for (const DeclaredAccess& access : declaration.accessesOfPass(pass)) {
    if (!access.writes()) continue;
    const std::string name(declaration.resources[access.resource].name);
    std::string readers;
    for (const Edge& edge : consumers) {
      if (edge.resource != access.resource) continue;
      readers += (readers.empty() ? "'" : ", '") + std::string(declaration.passes[edge.to].name) + "'";
    }
    if (!reason.empty()) reason += "; ";
    reason += readers.empty() ? "nothing reads what it writes to '" + name + "'"
                              : "what it writes to '" + name + "' is read only by culled " + readers;
  }
  return reason.empty() ? "it writes nothing and has no declared side effect" : reason;
}

}  // namespace

Culling cull(const Declaration& declaration, const Cells& cells, std::span<const uint32_t> sequence) {
  const auto passes = static_cast<uint32_t>(declaration.passes.size());
  Culling result;
  result.alive.assign(passes, 0);
  Needs needs(declaration, cells);
  uint32_t living = 0;
  for (std::size_t i = sequence.size(); i-- > 0;) {
    const uint32_t pass = sequence[i];
    if (!needs.wants(pass)) continue;
    result.alive[pass] = 1;
    ++living;
    needs.stepBefore(pass);
  }
  if (living == passes) return result;
  const Adjacency consumers(dataFlow(declaration, cells), passes, Adjacency::By::from);
  for (uint32_t pass = 0; pass < passes; ++pass) {
    if (!result.alive[pass]) result.culled.push_back({pass, reasonFor(declaration, pass, consumers.of(pass))});
  }
  return result;
}

}  // namespace lensgraph::rendergraph
