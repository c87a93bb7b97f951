// Compute passes with one dispatch. The dispatch is put together in the graph's arena while the chain of calls is made,
// and recorded from there.
#include "rendergraph/compute_pass.h"

#include <algorithm>
#include <memory>

#include "rendergraph/declare/declaration.h"

namespace lensgraph::rendergraph {

/// One dispatch. All of it lies in the arena and needs no destruction.
struct ComputeRecording {
  const ComputeProgram* program;
  std::span<Binding> bindings;
  std::span<const std::byte> pushConstants;
  std::span<const uint32_t> specialization;
  Groups groups;
  Buffer indirect;
  VkDeviceSize indirectOffset = 0;
};

namespace {

void recordDispatch(void* recording, PassContext& context) {
  const auto& dispatch = *static_cast<const ComputeRecording*>(recording);
  context.dispatch({.program = *dispatch.program,
                    .bindings = dispatch.bindings,
                    .pushConstants = dispatch.pushConstants,
                    .specialization = dispatch.specialization,
                    .groups = dispatch.groups,
                    .indirect = dispatch.indirect,
                    .indirectOffset = dispatch.indirectOffset});
}

template <class T>
T* allocate(Arena& arena, std::size_t count) {
  return static_cast<T*>(arena.allocate(count * sizeof(T), alignof(T)));
}

/// The list with one more element. It grows in place unless something else has been put behind it in the arena.
std::span<Binding> withOneMore(Arena& arena, std::span<Binding> list, const Binding& binding) {
  Binding* slot = allocate<Binding>(arena, 1);
  if (slot != list.data() + list.size()) {
    Binding* moved = list.empty() ? slot : allocate<Binding>(arena, list.size() + 1);
    std::uninitialized_copy(list.begin(), list.end(), moved);
    list = {moved, list.size()};
    slot = moved + list.size();
  }
  std::construct_at(slot, binding);
  return {list.data(), list.size() + 1};
}

}  // namespace

ComputePass compute(Graph& graph, std::string_view name, const ComputeProgram& program, std::source_location where) {
  return {graph.addPass(name, PassKind::compute, where), program};
}

ComputePass::ComputePass(Pass pass, const ComputeProgram& program) : pass_(pass) {
  Declaration& declaration = *pass_.declaration_;
  recording_ =
      std::construct_at(allocate<ComputeRecording>(declaration.arena, 1), ComputeRecording{.program = &program});
  declaration.passes[pass_.index_].unfinished = true;
  ++declaration.unfinishedPasses;
}

ComputePass& ComputePass::onlyIf(bool condition) {
  pass_.onlyIf(condition);
  return *this;
}

ComputePass& ComputePass::sideEffect() {
  pass_.sideEffect();
  return *this;
}

ComputePass& ComputePass::prefer(QueuePreference queue) {
  pass_.prefer(queue);
  return *this;
}

ComputePass& ComputePass::sample(Image image, const SamplerDesc& sampler, Subresources range, VkImageViewType viewType,
                                 Location where) {
  pass_.sample(image, range, 0, where);
  bind(sampled(image, sampler, range, viewType));
  return *this;
}

ComputePass& ComputePass::read(Image image, Subresources range, VkImageViewType viewType, Location where) {
  pass_.read(image, Usage::storage, range, 0, where);
  bind(storage(image, range, viewType));
  return *this;
}

ComputePass& ComputePass::read(Buffer buffer, Location where) {
  pass_.read(buffer, Usage::storage, 0, where);
  bind(storage(buffer));
  return *this;
}

ComputePass& ComputePass::write(Image& image, Subresources range, VkImageViewType viewType, Location where) {
  image = pass_.write(image, Usage::storage, range, 0, where);
  bind(storage(image, range, viewType));
  return *this;
}

ComputePass& ComputePass::write(Buffer& buffer, Location where) {
  buffer = pass_.write(buffer, Usage::storage, 0, where);
  bind(storage(buffer));
  return *this;
}

ComputePass& ComputePass::modify(Image& image, Subresources range, VkImageViewType viewType, Location where) {
  image = pass_.modify(image, Usage::storage, range, 0, where);
  bind(storage(image, range, viewType));
  return *this;
}

ComputePass& ComputePass::modify(Buffer& buffer, Location where) {
  buffer = pass_.modify(buffer, Usage::storage, 0, where);
  bind(storage(buffer));
  return *this;
}

ComputePass& ComputePass::uniform(Buffer buffer, Location where) {
  pass_.read(buffer, Usage::uniform, 0, where);
  bind(rendergraph::uniform(buffer));
  return *this;
}

ComputePass& ComputePass::placeholder(Location where) {
  const auto isStorageBuffer = [](const Binding& binding) { return binding.kind == Binding::Kind::storageBuffer; };
  const auto bound = recording_->bindings;
  const auto last = std::find_if(bound.rbegin(), bound.rend(), isStorageBuffer);
  if (last != bound.rend()) {
    bind(*last);
  } else {
    pass_.declaration_->report(Misuse::undeclaredAccess, pass_.index_, kNone,
                               "a placeholder has no storage buffer before it to stand for",
                               "bind a storage buffer before the placeholder", where);
  }
  return *this;
}

ComputePass& ComputePass::pushBytes(std::span<const std::byte> bytes) {
  auto* copy = static_cast<std::byte*>(pass_.declaration_->arena.allocate(bytes.size(), alignof(uint32_t)));
  std::ranges::copy(bytes, copy);
  recording_->pushConstants = {copy, bytes.size()};
  return *this;
}

ComputePass& ComputePass::specialize(std::initializer_list<SpecializationConstant> values) {
  auto* copy = allocate<uint32_t>(pass_.declaration_->arena, values.size());
  std::ranges::transform(values, copy, &SpecializationConstant::bits);
  recording_->specialization = {copy, values.size()};
  return *this;
}

void ComputePass::groups(const Groups& groups) {
  recording_->groups = groups;
  finish();
}

void ComputePass::indirect(Buffer buffer, VkDeviceSize offset, Location where) {
  pass_.read(buffer, Usage::indirect, 0, where);
  recording_->indirect = buffer;
  recording_->indirectOffset = offset;
  finish();
}

void ComputePass::bind(const Binding& binding) {
  recording_->bindings = withOneMore(pass_.declaration_->arena, recording_->bindings, binding);
}

void ComputePass::finish() {
  pass_.setRecording(recording_, recordDispatch, nullptr);
  DeclaredPass& pass = pass_.declaration_->passes[pass_.index_];
  if (pass.unfinished) --pass_.declaration_->unfinishedPasses;
  pass.unfinished = false;
}

}  // namespace lensgraph::rendergraph
