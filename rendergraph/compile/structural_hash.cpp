// The key of the plan cache: every byte of the structures that compile() reads, and the options. Names, recordings,
// clear values, source locations and the host's Vulkan objects are not in them, so that changing those keeps the plan.
// The mixing is after wyhash (Wang Yi, "wyhash", public domain): 128-bit products of 16 bytes at a time.
#include <bit>
#include <cstring>
#include <iterator>
#include <type_traits>

#include "rendergraph/compiler.h"
#include "rendergraph/declare/declaration.h"

namespace lensgraph::rendergraph {

namespace {

// Random bits, one word for each pair of words of a structure, so that the place counts.
constexpr uint64_t kSalts[] = {0x2D358DCCAA6C78A5ull, 0x8BB84B93962EACC9ull, 0x4B33A62ED433D4A3ull,
                               0x4D5A2DA51DE1AA47ull};

class Hash {
 public:
  /// Any structure without padding. Its products wait for the structure before the last one, not for the last and not
  /// for each other: two chains side by side, since a product takes longer than anything else here.
  template <class T>
  void add(const T& value) {
    static_assert(std::has_unique_object_representations_v<T> && sizeof(T) % 8 == 0);
    constexpr std::size_t kWords = sizeof(T) / 8;
    static_assert(kWords <= 2 * std::size(kSalts));
    const auto word = [&](std::size_t i) {
      uint64_t result = 0;
      if (i < kWords) std::memcpy(&result, reinterpret_cast<const std::byte*>(&value) + 8 * i, 8);
      return result;
    };
    uint64_t mixed = 0;
    for (std::size_t i = 0; i < kWords; i += 2) mixed ^= product(word(i) ^ kSalts[i / 2], word(i + 1) ^ older_);
    older_ = newer_;
    newer_ = mixed;
  }
  uint64_t value() const { return product(product(older_ ^ kSalts[0], kSalts[1]) ^ newer_, kSalts[2]); }

 private:
  static uint64_t product(uint64_t a, uint64_t b) {
    __extension__ using Wide = unsigned __int128;
    const Wide wide = static_cast<Wide>(a) * b;
    return static_cast<uint64_t>(wide) ^ static_cast<uint64_t>(wide >> 64);
  }
  uint64_t older_ = 0x243F6A8885A308D3ull, newer_ = 0x13198A2E03707344ull;
};

struct StateWords {
  uint64_t beforeStages, beforeAccess, afterStages, afterAccess;
  VkImageLayout beforeLayout, afterLayout;
};

struct Head {
  uint64_t resources, passes, accesses;
  uint32_t order, aliasing, barriers, splitDistance, mergeRasterPasses, useQueues, overlappingFrames, memoryBudget;
};

}  // namespace

uint64_t structuralHash(const Declaration& declaration, const CompileOptions& options) {
  Hash hash;
  hash.add(Head{.resources = declaration.resources.size(),
                .passes = declaration.passes.size(),
                .accesses = declaration.accesses.size(),
                .order = static_cast<uint32_t>(options.order),
                .aliasing = static_cast<uint32_t>(options.aliasing),
                .barriers = static_cast<uint32_t>(options.barriers),
                .splitDistance = options.splitDistance,
                .mergeRasterPasses = options.mergeRasterPasses,
                .useQueues = options.useQueues,
                .overlappingFrames = options.overlappingFrames,
                .memoryBudget = std::bit_cast<uint32_t>(options.memoryBudget)});
  for (const DeclaredResource& resource : declaration.resources) {
    hash.add<ResourceStructure>(resource);
    if (!resource.stated) continue;
    const AccessState &before = resource.before, &after = resource.after;
    hash.add(StateWords{.beforeStages = before.stages,
                        .beforeAccess = before.access,
                        .afterStages = after.stages,
                        .afterAccess = after.access,
                        .beforeLayout = before.layout,
                        .afterLayout = after.layout});
  }
  for (const DeclaredPass& pass : declaration.passes) hash.add<PassStructure>(pass);
  for (const DeclaredAccess& access : declaration.accesses) hash.add<AccessStructure>(access);
  return hash.value();
}

}  // namespace lensgraph::rendergraph
