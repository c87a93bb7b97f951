// Heaps and placements of a plan, recomputed from the declaration.
#include <algorithm>
#include <string>

#include "plan_checker/plan_structure.h"

namespace lensgraph::plan_checker {

using namespace rendergraph;

namespace {

struct Life {
  uint32_t first = UINT32_MAX, last = 0;
  bool used() const { return first != UINT32_MAX; }
};

std::vector<Life> livesOf(const Setting& setting) {
  const Declaration& declaration = setting.declaration;
  std::vector<uint32_t> stepOfPass(declaration.passes.size(), UINT32_MAX);
  const auto steps = static_cast<uint32_t>(setting.plan.passes.size());
  for (uint32_t step = 0; step < steps; ++step) stepOfPass[setting.plan.passes[step].pass] = step;
  std::vector<Life> lives(declaration.resources.size());
  for (const DeclaredAccess& access : declaration.accesses) {
    const uint32_t step = stepOfPass[access.pass];
    if (step == UINT32_MAX) continue;
    Life& life = lives[access.resource];
    life.first = std::min(life.first, step);
    life.last = std::max(life.last, step);
    if (declaration.resources[access.resource].exported) life.last = steps;
  }
  return lives;
}

class Memory {
 public:
  explicit Memory(const Setting& setting) : setting_(setting), plan_(setting.plan), lives_(livesOf(setting)) {}

  std::vector<Finding> check() {
    std::vector<uint32_t> times(lives_.size(), 0);
    std::vector<uint32_t> holds(plan_.heaps.size(), 0);
    for (const Placement& placement : plan_.placements) {
      if (placement.resource >= lives_.size() || placement.heap >= plan_.heaps.size()) {
        expect(false, "a placement of no resource or in no heap");
        return std::move(findings_);
      }
      ++times[placement.resource];
      ++holds[placement.heap];
      checkPlacement(placement);
    }
    for (const PersistentResource& persistent : plan_.persistent) ++times[persistent.resource];
    for (uint32_t i = 0; i < lives_.size(); ++i) {
      const bool expected = lives_[i].used() && !setting_.declaration.resources[i].imported();
      expect(times[i] == (expected ? 1u : 0u), nameOf(i) + " is placed or persistent too often or not at all");
    }
    for (uint32_t heap = 0; heap < plan_.heaps.size(); ++heap) {
      expect(holds[heap] == 1 || (holds[heap] > 1 && !plan_.heaps[heap].dedicated), "a heap holds too few or too many");
    }
    if (setting_.options.aliasing == Aliasing::none) checkSeparate();
    checkReport();
    return std::move(findings_);
  }

 private:
  std::string nameOf(uint32_t resource) const {
    return "'" + std::string(setting_.declaration.resources[resource].name) + "'";
  }
  void expect(bool holds, const std::string& what) {
    if (!holds) findings_.push_back({Hazard::memory, what});
  }

  void checkPlacement(const Placement& placement) {
    const DeclaredResource& resource = setting_.declaration.resources[placement.resource];
    const PlannedHeap& heap = plan_.heaps[placement.heap];
    const MemoryRequirements needed = resource.isImage
                                          ? setting_.device.requirements(resource.image, placement.imageUsage)
                                          : setting_.device.requirements(resource.buffer, placement.bufferUsage);
    const std::string name = nameOf(placement.resource);
    expect(resource.created(), name + " is placed and not of the graph");
    expect(placement.size >= needed.size, name + " is placed in too few bytes");
    expect(placement.offset <= heap.size && placement.size <= heap.size - placement.offset, name + " leaves its heap");
    expect(placement.offset % needed.alignment == 0, name + " is not aligned");
    expect(heap.memoryTypeBits != 0 && (heap.memoryTypeBits & ~needed.memoryTypeBits) == 0,
           name + " is in memory of a type that it does not allow");
    expect(heap.memory == (resource.isImage ? MemoryKind::device : resource.buffer.memory),
           name + " is in memory of the wrong kind");
    expect(heap.dedicated == needed.dedicated, name + " is in shared memory and wants its own, or the other way round");
    const Life& life = lives_[placement.resource];
    expect(placement.firstStep == life.first && placement.lastStep == life.last, name + " has another lifetime");
  }

  void checkSeparate() {
    for (const Placement& a : plan_.placements) {
      for (const Placement& b : plan_.placements) {
        const bool shared = a.heap == b.heap && a.offset < b.offset + b.size && b.offset < a.offset + a.size;
        expect(&a == &b || !shared, nameOf(a.resource) + " shares memory although aliasing is off");
      }
    }
  }

  void checkReport() {
    VkDeviceSize heaps = 0, sizes = 0, bound = 0;
    std::vector<VkDeviceSize> begins(plan_.passes.size() + 2, 0), ends(plan_.passes.size() + 2, 0);
    for (const PlannedHeap& heap : plan_.heaps) heaps += heap.size;
    for (const Placement& placement : plan_.placements) {
      sizes += placement.size;
      begins[placement.firstStep] += placement.size;
      ends[placement.lastStep] += placement.size;
    }
    VkDeviceSize alive = 0;
    for (std::size_t step = 0; step < begins.size(); ++step) {
      alive += begins[step];
      bound = std::max(bound, alive);
      alive -= ends[step];
    }
    expect(plan_.memory.peakBytes == heaps, "the reported peak is not the sum of the heaps");
    expect(plan_.memory.unaliasedBytes >= sizes, "the reported unaliased bytes are fewer than the sum of the sizes");
    // Memory that changes hands between groups of passes or renderings only, or not between queues, counts as alive for longer.
    const bool longer = setting_.options.order == Order::fewestBatches || setting_.options.mergeRasterPasses ||
                        std::any_of(plan_.submissions.begin(), plan_.submissions.end(),
                                    [](const PlannedSubmission& submission) { return submission.queue != 0; });
    expect(longer ? plan_.memory.lowerBound >= bound : plan_.memory.lowerBound == bound,
           "the reported lower bound is not the largest sum alive at once");
    expect(plan_.memory.lowerBound <= plan_.memory.peakBytes, "the reported peak is below its lower bound");
  }

  const Setting& setting_;
  const Plan& plan_;
  std::vector<Life> lives_;
  std::vector<Finding> findings_;
};

}  // namespace

std::vector<Finding> checkMemory(const Setting& setting) {
  return Memory(setting).check();
}

}  // namespace lensgraph::plan_checker
