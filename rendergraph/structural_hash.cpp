// The key of the plan cache. Every field that compile() reads is mixed in; names, recordings, clear values, source
// locations and the host's Vulkan objects are not, so that changing them keeps the plan.
#include <bit>

#include "rendergraph/compiler.h"
#include "rendergraph/declaration.h"

namespace rendergraph {

namespace {

class Hash {
 public:
  template <class... Words>
  void add(Words... words) {
    (mix(static_cast<uint64_t>(words)), ...);
  }
  uint64_t value() const {
    uint64_t z = state_;  // Last step of splitmix64, so that low bits depend on all.
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
    return z ^ (z >> 31);
  }

 private:
  void mix(uint64_t word) {
    state_ = std::rotl(state_ ^ (word * 0x9E3779B97F4A7C15ull), 29) * 0xD6E8FEB86659FD93ull + 0x2545F4914F6CDD1Dull;
  }
  uint64_t state_ = 0x243F6A8885A308D3ull;
};

void addState(Hash& hash, const AccessState& state) {
  hash.add(state.stages, state.access, state.layout);
}

void addResource(Hash& hash, const DeclaredResource& resource) {
  hash.add(resource.isImage, resource.origin, resource.exported, resource.importedImageUsage,
           resource.importedBufferUsage);
  const ImageDesc& image = resource.image;
  hash.add(image.format, image.width, image.height, image.layers, image.mips, image.samples, image.extraUsage);
  hash.add(resource.buffer.size, resource.buffer.memory, resource.buffer.extraUsage);
  addState(hash, resource.before);
  addState(hash, resource.after);
}

void addPass(Hash& hash, const DeclaredPass& pass) {
  hash.add(pass.kind, pass.queue, pass.sideEffect, pass.renderArea.width, pass.renderArea.height, pass.renderLayers);
}

void addAccess(Hash& hash, const DeclaredAccess& access) {
  hash.add(access.pass, access.resource, access.usage, access.mode, access.role, access.load, access.stages);
  const Subresources& range = access.range;
  hash.add(range.firstMip, range.mipCount, range.firstLayer, range.layerCount, range.aspects);
}

}  // namespace

uint64_t structuralHash(const Declaration& declaration, const CompileOptions& options) {
  Hash hash;
  hash.add(options.order, options.aliasing, options.barriers, options.splitDistance, options.mergeRasterPasses,
           options.useQueues, options.overlappingFrames);
  hash.add(declaration.resources.size(), declaration.passes.size(), declaration.accesses.size());
  for (const DeclaredResource& resource : declaration.resources) addResource(hash, resource);
  for (const DeclaredPass& pass : declaration.passes) addPass(hash, pass);
  for (const DeclaredAccess& access : declaration.accesses) addAccess(hash, access);
  return hash.value();
}

}  // namespace rendergraph
