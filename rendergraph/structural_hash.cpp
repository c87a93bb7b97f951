// The key of the plan cache: every byte of the structures that compile() reads, and the options. Names, recordings,
// clear values, source locations and the host's Vulkan objects are not in them, so that changing those keeps the plan.
// The mixing is that of wyhash (Wang Yi, "wyhash", public domain): 128-bit products of 16 bytes at a time.
#include <bit>
#include <cstring>
#include <iterator>
#include <type_traits>

#include "rendergraph/compiler.h"
#include "rendergraph/declaration.h"

namespace rendergraph {

namespace {

class Hash {
 public:
  /// Any structure without padding, in steps of eight bytes.
  template <class T>
  void add(const T& value) {
    static_assert(std::has_unique_object_representations_v<T> && sizeof(T) % 8 == 0);
    uint64_t words[sizeof(T) / 8];
    std::memcpy(words, &value, sizeof(T));
    for (std::size_t i = 0; i < std::size(words); i += 2) {
      // Two chains of products, since each one waits for the last.
      uint64_t& state = i % 4 == 0 ? even_ : odd_;
      state = product(words[i] ^ kFirst, (i + 1 < std::size(words) ? words[i + 1] : kSecond) ^ state);
    }
  }
  uint64_t value() const { return product(even_ ^ kFirst, product(odd_ ^ kSecond, kFirst)); }

 private:
  static constexpr uint64_t kFirst = 0x2D358DCCAA6C78A5ull, kSecond = 0x8BB84B93962EACC9ull;
  static uint64_t product(uint64_t a, uint64_t b) {
    __extension__ using Wide = unsigned __int128;
    const Wide wide = static_cast<Wide>(a) * b;
    return static_cast<uint64_t>(wide) ^ static_cast<uint64_t>(wide >> 64);
  }
  uint64_t even_ = 0x243F6A8885A308D3ull, odd_ = 0x13198A2E03707344ull;
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

}  // namespace rendergraph
