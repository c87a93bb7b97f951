// Looks plans up by structural hash, and makes the objects behind them.
#include "rendergraph/execute/frame/plan_store.h"

#include <limits>
#include <memory>
#include <utility>

#include "rendergraph/compiler.h"
#include "rendergraph/declare/declaration.h"

namespace lensgraph::rendergraph {

bool PlanStore::select(const Declaration& declaration, const CompileOptions& options) {
  // Problems with handles leave no trace in the structure, so an equal structure does not excuse them.
  if (auto problems = declaration.allProblems(); !problems.empty()) throw GraphError(std::move(problems));
  current_ = nullptr;
  const uint64_t hash = structuralHash(declaration, options);
  CachedPlan* found = plans_.find(hash);
  const bool known = found != nullptr;
  if (!known) found = &plans_.add(hash, compile(declaration, options, backend_));
  ++(known ? reused_ : compiled_);
  current_ = found;
  return known;
}

void PlanStore::makeObjects(const Declaration& declaration, uint32_t frameInFlight) {
  plans_.releaseResources(PlanCache::kWithResources);
  if (!current_->resources) current_->resources = std::make_unique<PlanResources>(framesInFlight_);
  current_->resources->prepare(backend_, pool_, declaration, current_->plan, frameInFlight);
}

void PlanStore::enterInto(ResourceTable& table, const Declaration& declaration, uint32_t frameInFlight) {
  current_->resources->enterInto(table, current_->plan, frameInFlight);
  persistent_.prepare(declaration, current_->plan, table);
}

void PlanStore::commit(uint64_t frame) {
  persistent_.commit();
  isFirst_ = false;
  previousHash_ = current_->hash;
  deletionQueue_.setLastUser(frame);
}

void PlanStore::abandon() {
  isFirst_ = false;
  previousHash_ = 0;
  persistent_.invalidate();
}

void PlanStore::distrust() {
  previousHash_ = 0;
  persistent_.invalidateAll();
}

void PlanStore::clear() {
  current_ = nullptr;
  previousHash_ = 0;
  persistent_.clear();
  plans_.clear();
  deletionQueue_.release(std::numeric_limits<uint64_t>::max());
}

}  // namespace lensgraph::rendergraph
