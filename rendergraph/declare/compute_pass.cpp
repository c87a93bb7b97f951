// Compute passes with one dispatch. The chain of calls puts the dispatch together in the graph's arena; the executor
// records it from there. A binding is the index of the access that was declared for it, so nothing has to be looked up.
#include "rendergraph/compute_pass.h"

#include <algorithm>
#include <memory>
#include <string>

#include "rendergraph/declare/declaration.h"

namespace lensgraph::rendergraph {

namespace {

template <class T>
T* allocate(Arena& arena, std::size_t count) {
  return static_cast<T*>(arena.allocate(count * sizeof(T), alignof(T)));
}

/// The list with one more element. It grows in place unless something else has been put behind it in the arena.
std::span<const DispatchBinding> withOneMore(Arena& arena, std::span<const DispatchBinding> list,
                                             const DispatchBinding& binding) {
  DispatchBinding* slot = allocate<DispatchBinding>(arena, 1);
  if (slot == list.data() + list.size()) {
    std::construct_at(slot, binding);
    return {list.data(), list.size() + 1};
  }
  DispatchBinding* moved = list.empty() ? slot : allocate<DispatchBinding>(arena, list.size() + 1);
  std::uninitialized_copy(list.begin(), list.end(), moved);
  std::construct_at(moved + list.size(), binding);
  return {moved, list.size() + 1};
}

}  // namespace

ComputePass compute(Graph& graph, std::string_view name, const ComputeProgram& program, std::source_location where) {
  return {graph.addPass(name, PassKind::compute, where), program};
}

ComputePass::ComputePass(Pass pass, const ComputeProgram& program) : pass_(pass) {
  Declaration& declaration = *pass_.declaration_;
  dispatch_ = std::construct_at(allocate<DeclaredDispatch>(declaration.arena, 1));
  dispatch_->program = &program;
  DeclaredPass& declared = declaration.passes[pass_.index_];
  declared.dispatch = dispatch_;
  declared.unfinished = true;
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
  return bind(image, viewType, sampler, where);
}

ComputePass& ComputePass::read(Image image, Subresources range, VkImageViewType viewType, Location where) {
  pass_.read(image, Usage::storage, range, 0, where);
  return bind(image, viewType, {}, where);
}

ComputePass& ComputePass::read(Buffer buffer, Location where) {
  pass_.read(buffer, Usage::storage, 0, where);
  return bind();
}

ComputePass& ComputePass::write(Image& image, Subresources range, VkImageViewType viewType, Location where) {
  image = pass_.write(image, Usage::storage, range, 0, where);
  return bind(image, viewType, {}, where);
}

ComputePass& ComputePass::write(Buffer& buffer, Location where) {
  buffer = pass_.write(buffer, Usage::storage, 0, where);
  return bind();
}

ComputePass& ComputePass::modify(Image& image, Subresources range, VkImageViewType viewType, Location where) {
  image = pass_.modify(image, Usage::storage, range, 0, where);
  return bind(image, viewType, {}, where);
}

ComputePass& ComputePass::modify(Buffer& buffer, Location where) {
  buffer = pass_.modify(buffer, Usage::storage, 0, where);
  return bind();
}

ComputePass& ComputePass::uniform(Buffer buffer, Location where) {
  pass_.read(buffer, Usage::uniform, 0, where);
  return bind();
}

ComputePass& ComputePass::placeholder(Location where) {
  Declaration& declaration = *pass_.declaration_;
  if (declaration.passes[pass_.index_].disabled) return *this;
  const auto isStorageBuffer = [&](const DispatchBinding& binding) {
    const DeclaredAccess& access = declaration.accesses[binding.access];
    return access.usage == Usage::storage && !declaration.resources[access.resource].isImage;
  };
  const auto bound = dispatch_->bindings;
  const auto last = std::find_if(bound.rbegin(), bound.rend(), isStorageBuffer);
  if (last != bound.rend()) {
    dispatch_->bindings = withOneMore(declaration.arena, bound, *last);
  } else {
    declaration.report(Misuse::undeclaredAccess, pass_.index_, kNone,
                       "a placeholder has no storage buffer before it to stand for",
                       "bind a storage buffer before the placeholder", where);
  }
  return *this;
}

ComputePass& ComputePass::pushBytes(std::span<const std::byte> bytes) {
  auto* copy = static_cast<std::byte*>(pass_.declaration_->arena.allocate(bytes.size(), alignof(uint32_t)));
  std::ranges::copy(bytes, copy);
  dispatch_->pushConstants = {copy, bytes.size()};
  return *this;
}

ComputePass& ComputePass::specialize(std::initializer_list<SpecializationConstant> values) {
  auto* copy = allocate<uint32_t>(pass_.declaration_->arena, values.size());
  std::ranges::transform(values, copy, &SpecializationConstant::bits);
  dispatch_->specialization = {copy, values.size()};
  return *this;
}

void ComputePass::groups(const Groups& groups) {
  dispatch_->groups = groups;
  finish();
}

void ComputePass::indirect(Buffer buffer, VkDeviceSize offset, Location where) {
  pass_.read(buffer, Usage::indirect, 0, where);
  dispatch_->indirect = buffer.resource;
  dispatch_->indirectOffset = offset;
  finish();
}

ComputePass& ComputePass::bind() {
  return bind({}, VK_IMAGE_VIEW_TYPE_2D, {}, {});
}

ComputePass& ComputePass::bind(Image image, VkImageViewType viewType, const SamplerDesc& sampler, Location where) {
  Declaration& declaration = *pass_.declaration_;
  if (declaration.passes[pass_.index_].disabled) return *this;  // No access was declared.
  const DeclaredAccess& access = declaration.accesses.back();
  const Subresources& range = access.range;
  if (access.usage == Usage::storage && range.mipCount > 1) {
    declaration.report(Misuse::subresourceRange, pass_.index_, image.resource, "a storage image binding shows one mip",
                       "name one mip", where);
  }
  if (viewType == VK_IMAGE_VIEW_TYPE_2D && range.layerCount > 1) {
    declaration.report(Misuse::subresourceRange, pass_.index_, image.resource,
                       "a view of type 2D cannot show " + std::to_string(range.layerCount) + " layers",
                       "name one layer, or use VK_IMAGE_VIEW_TYPE_2D_ARRAY", where);
  }
  dispatch_->bindings = withOneMore(declaration.arena, dispatch_->bindings,
                                    {.access = declaration.numberOf(access), .viewType = viewType, .sampler = sampler});
  return *this;
}

void ComputePass::finish() {
  Declaration& declaration = *pass_.declaration_;
  DeclaredPass& pass = declaration.passes[pass_.index_];
  if (pass.unfinished) --declaration.unfinishedPasses;
  pass.unfinished = false;
}

}  // namespace lensgraph::rendergraph
