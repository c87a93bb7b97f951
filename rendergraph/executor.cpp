// The public face: one execution from declaration to results, and the questions one may ask afterwards.
#include "rendergraph/executor.h"

#include <algorithm>
#include <string>

#include "rendergraph/capture_bytes.h"
#include "rendergraph/executor_state.h"
#include "rendergraph/frame.h"
#include "rendergraph/naming.h"

namespace rendergraph {

void ExportTable::take(const Declaration& declaration, const BindingTable& table) {
  serial = declaration.serial;
  bound = table;
  exported.clear();
  sizes.clear();
  for (const DeclaredResource& resource : declaration.resources) {
    exported.push_back(resource.exported);
    sizes.push_back(resource.isImage ? 0 : resource.buffer.size);
  }
}

namespace {

template <class Tag>
const Bound& exportedOf(const ExportTable& exports, const Handle<Tag>& handle) {
  const auto fail = [](Misuse misuse, const char* reason, const char* remedy) {
    throw GraphError({{.misuse = misuse, .pass = {}, .resource = {}, .reason = reason, .remedy = remedy, .where = {}}});
  };
  if (!handle) {
    fail(Misuse::unknownHandle, "the handle was never given a resource", "use a handle that the graph returned");
  }
  if (handle.graph != exports.serial || handle.resource >= exports.bound.size()) {
    fail(Misuse::foreignHandle, "the handle does not belong to the graph executed last",
         "look exports up before the next execution");
  }
  if (!exports.exported[handle.resource]) {
    fail(Misuse::importState, "the resource was not exported", "call exportImage() or exportBuffer() on it");
  }
  return exports.bound[handle.resource];
}

}  // namespace

void Executor::State::makeResources() {
  plans.releaseResources(PlanCache::kWithResources);
  if (current->resources) return;
  try {
    current->resources = std::make_unique<PlanResources>(backend, pool, *declaration, current->plan);
  } catch (const GraphError&) {
    // The other plans' objects may be what fills the memory; without them it gets one more chance.
    plans.releaseResources(1);
    current->resources = std::make_unique<PlanResources>(backend, pool, *declaration, current->plan);
  }
}

void Executor::State::prepare(const Declaration& declared, const CompileOptions& options) {
  // Problems with handles leave no trace in the structure, so an equal structure does not excuse them.
  if (!declared.problems.empty()) throw GraphError(declared.problems);
  current = nullptr;
  exports = {};
  importedViews.clear();
  declaration = &declared;
  const uint64_t hash = structuralHash(declared, options);
  CachedPlan* found = plans.find(hash);
  capture.planReused = found != nullptr;
  if (found != nullptr) {
    ++reused;
  } else {
    found = &plans.add(hash, compile(declared, options, backend));
    ++compiled;
  }
  current = found;
  bound.assign(declared.resources.size(), {});
  for (uint32_t index = 0; index < declared.resources.size(); ++index) {
    const DeclaredResource& resource = declared.resources[index];
    if (!resource.imported()) continue;
    bound[index] = {.image = resource.importedImage, .buffer = resource.importedBuffer, .views = &importedViews};
  }
  makeResources();
  current->resources->bind(current->plan, bound);
  retained.prepare(declared, current->plan, bound);
}

VkImageView Executor::State::viewOf(uint32_t resource, const Subresources& range, VkImageViewType type) {
  const DeclaredResource& declared = declaration->resources[resource];
  const Bound& object = bound[resource];
  return namingResource(declared.name, [&] {
    return object.views->get(
        backend, {.image = object.image, .format = declared.image.format, .type = type, .range = range}, declared.name);
  });
}

void Executor::State::finish() {
  declaration = nullptr;
  planned = nullptr;
}

Executor::Executor(Backend& backend) : state_(std::make_unique<State>(backend)) {}
Executor::~Executor() = default;

void Executor::execute(const Graph& graph, const ExecuteOptions& options) {
  const Clock::time_point start = Clock::now();
  const Declaration& declaration = graph.declaration();
  Frame frame(*this, *state_, options.timing);
  try {
    state_->prepare(declaration, options.compile);
    beginCapture(state_->capture, declaration, state_->current->plan, options.timing);
    frame.execute();
  } catch (...) {
    if (frame.submitted()) state_->retained.invalidate();
    state_->importedViews.clear();
    state_->finish();
    throw;
  }
  state_->retained.commit();
  state_->importedViews.clear();
  state_->exports.take(declaration, state_->bound);
  state_->capture.frameWallMs = millisecondsSince(start);
  state_->finish();
}

void Executor::record(const Graph& graph, VkCommandBuffer commands, const ExecuteOptions& options) {
  const Clock::time_point start = Clock::now();
  const Declaration& declaration = graph.declaration();
  Frame frame(*this, *state_, Timing::none);
  try {
    state_->prepare(declaration, options.compile);
    beginCapture(state_->capture, declaration, state_->current->plan, Timing::none);
    frame.record(commands);
  } catch (...) {
    state_->finish();
    throw;
  }
  state_->retained.commit();
  state_->exports.take(declaration, state_->bound);
  state_->capture.frameWallMs = millisecondsSince(start);
  state_->finish();
}

const Plan& Executor::plan() const {
  static const Plan kEmpty;
  return state_->current != nullptr ? state_->current->plan : kEmpty;
}

const Capture& Executor::capture() const {
  return state_->capture;
}

VkImage Executor::exportedImage(Image image) const {
  return exportedOf(state_->exports, image).image;
}

VkBuffer Executor::exportedBuffer(Buffer buffer) const {
  return exportedOf(state_->exports, buffer).buffer;
}

std::span<const std::byte> Executor::mapped(Buffer buffer) const {
  const Bound& bound = exportedOf(state_->exports, buffer);
  if (bound.address == nullptr) return {};
  return {bound.address, static_cast<std::size_t>(state_->exports.sizes[buffer.resource])};
}

uint64_t Executor::plansCompiled() const {
  return state_->compiled;
}
uint64_t Executor::plansReused() const {
  return state_->reused;
}

void Executor::clear() {
  state_->current = nullptr;
  state_->exports = {};
  state_->importedViews.clear();
  state_->retained.clear();
  state_->plans.clear();
}

}  // namespace rendergraph
