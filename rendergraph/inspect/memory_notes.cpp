// Compares every placement with the others of its kind of memory, and says in words with whom it shares bytes and why not.
#include "rendergraph/memory_notes.h"

#include <algorithm>

#include "rendergraph/declare/declaration.h"

namespace lensgraph::rendergraph {

namespace {

constexpr std::size_t kNamed = 4;  // More names than these make no sentence clearer.

std::string listed(const Declaration& declaration, const std::vector<uint32_t>& resources) {
  std::string text;
  for (std::size_t i = 0; i < std::min(kNamed, resources.size()); ++i) {
    text += (i == 0 ? "'" : ", '") + std::string(declaration.resources[resources[i]].name) + "'";
  }
  if (resources.size() > kNamed) text += " and " + std::to_string(resources.size() - kNamed) + " more";
  return text;
}

bool sameBytes(const Placement& a, const Placement& b) {
  return a.heap == b.heap && a.offset < b.offset + b.size && b.offset < a.offset + a.size;
}

bool together(const Placement& a, const Placement& b) {
  return a.firstStep <= b.lastStep && b.firstStep <= a.lastStep;
}

std::string noteOn(const Declaration& declaration, const Plan& plan, const Placement& placement) {
  if (plan.heaps[placement.heap].dedicated) return "the device wants an allocation for it alone";
  std::vector<uint32_t> sharing, living, other;
  for (const Placement& candidate : plan.placements) {
    if (candidate.resource == placement.resource) continue;
    if (plan.heaps[candidate.heap].memory != plan.heaps[placement.heap].memory) continue;
    if (sameBytes(candidate, placement)) {
      sharing.push_back(candidate.resource);
    } else if (together(candidate, placement)) {
      living.push_back(candidate.resource);
    } else {
      other.push_back(candidate.resource);
    }
  }
  if (!sharing.empty()) return "shares memory with " + listed(declaration, sharing);
  const bool exported = declaration.resources[placement.resource].exported;
  const std::string until = exported ? " (it is exported, so it stays until the end)" : "";
  if (living.empty() && other.empty()) return "nothing else of the graph lies in this kind of memory";
  if (other.empty()) return "alive together with all others: " + listed(declaration, living) + until;
  return "shares none: " + listed(declaration, other) + ", alive at other times, found room elsewhere" + until;
}

}  // namespace

std::vector<std::string> memoryNotes(const Declaration& declaration, const Plan& plan) {
  std::vector<std::string> notes;
  for (const DeclaredResource& resource : declaration.resources) {
    notes.emplace_back(resource.imported()     ? "the host's own memory"
                       : resource.persistent() ? "kept across frames, so its memory is its own"
                                               : "no living pass uses it");
  }
  for (const Placement& placement : plan.placements) {
    notes[placement.resource] = noteOn(declaration, plan, placement);
  }
  return notes;
}

}  // namespace lensgraph::rendergraph
