// A compute pass with one dispatch: an access is its binding, so every resource is named once.
//
//   compute(graph, "blur.horizontal", kHorizontal)
//       .read(source).write(result).read(tiles).push(constants).groups(groupsFor(extent, 8));
//
// Element i of the chain is binding i of descriptor set 0. What dispatches several times, or not always the same way, is
// declared with Graph::addPass().
#pragma once

#include <vulkan/vulkan_core.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <source_location>
#include <span>
#include <string_view>
#include <type_traits>

#include "rendergraph/graph.h"
#include "rendergraph/handle.h"
#include "rendergraph/pass.h"
#include "rendergraph/program.h"
#include "rendergraph/resource.h"

namespace lensgraph::rendergraph {

/// The value of one constant_id. Converts from what shaders have: bool, integers, float; enumerations by their value.
struct SpecializationConstant {
  template <class T>
  requires((std::is_integral_v<T> && sizeof(T) <= 4) || std::is_enum_v<T>) constexpr SpecializationConstant(T value)
      : bits(static_cast<uint32_t>(value)) {}
  constexpr SpecializationConstant(float value) : bits(std::bit_cast<uint32_t>(value)) {}

  uint32_t bits;
};

struct DeclaredDispatch;  // declare/declaration.h: the dispatch, in the graph's arena.

/// Declares a compute pass with one dispatch, by a chain of calls that groups() or indirect() ends. Made by compute(); it
/// must not outlive the graph. Errors are GraphErrors as those of Pass, with the source line of the call.
/// `range`: default, all of the image; a storage image is bound with one mip. `viewType`: 2D_ARRAY for image2DArray and
/// sampler2DArray.
class ComputePass {
 public:
  using Location = std::source_location;

  ComputePass(const ComputePass&) = delete;
  ComputePass& operator=(const ComputePass&) = delete;

  /// As Pass::onlyIf(), sideEffect() and prefer(). onlyIf() comes first.
  ComputePass& onlyIf(bool condition);
  ComputePass& sideEffect();
  ComputePass& prefer(QueuePreference queue);

  /// A combined image sampler.
  ComputePass& sample(Image image, const SamplerDesc& sampler = {}, Subresources range = {},
                      VkImageViewType viewType = VK_IMAGE_VIEW_TYPE_2D, Location where = Location::current());
  /// A storage image or buffer that the shader only reads.
  ComputePass& read(Image image, Subresources range = {}, VkImageViewType viewType = VK_IMAGE_VIEW_TYPE_2D,
                    Location where = Location::current());
  ComputePass& read(Buffer buffer, Location where = Location::current());
  /// A storage image or buffer whose content the shader replaces. The handle becomes that of the result.
  ComputePass& write(Image& image, Subresources range = {}, VkImageViewType viewType = VK_IMAGE_VIEW_TYPE_2D,
                     Location where = Location::current());
  ComputePass& write(Buffer& buffer, Location where = Location::current());
  /// A storage image or buffer that the shader reads and writes: atomics, partial writes, accumulation in place. The
  /// handle becomes that of the result.
  ComputePass& modify(Image& image, Subresources range = {}, VkImageViewType viewType = VK_IMAGE_VIEW_TYPE_2D,
                      Location where = Location::current());
  ComputePass& modify(Buffer& buffer, Location where = Location::current());
  /// A uniform buffer.
  ComputePass& uniform(Buffer buffer, Location where = Location::current());
  /// A storage buffer that the shader does not touch in this configuration: what is bound, since Vulkan wants something
  /// there, is the storage buffer bound before it.
  ComputePass& placeholder(Location where = Location::current());

  /// Push constants, copied into the graph: a plain struct of at most 128 bytes, which every device takes.
  template <class T>
  ComputePass& push(const T& value) {
    static_assert(std::is_trivially_copyable_v<T> && sizeof(T) % 4 == 0 && sizeof(T) <= 128);
    return pushBytes(bytesOf(value));
  }
  /// The values of constant_id 0, 1, …, copied into the graph.
  ComputePass& specialize(std::initializer_list<SpecializationConstant> values);

  /// Ends the declaration: that many work groups.
  void groups(const Groups& groups);
  /// Ends the declaration: the group counts are three words of the buffer, `offset` bytes after its start.
  void indirect(Buffer buffer, VkDeviceSize offset = 0, Location where = Location::current());

 private:
  friend ComputePass compute(Graph& graph, std::string_view name, const ComputeProgram& program, Location where);

  ComputePass(Pass pass, const ComputeProgram& program);
  ComputePass& bind(Image image, VkImageViewType viewType, const SamplerDesc& sampler, Location where);
  ComputePass& bind();
  ComputePass& pushBytes(std::span<const std::byte> bytes);
  void finish();

  Pass pass_;
  DeclaredDispatch* dispatch_;
};

/// Begins a compute pass. `name` is the pass's, which may differ from the program's; `program` has static storage
/// duration. compile() refuses a pass whose chain has no end (unfinishedPass).
[[nodiscard]] ComputePass compute(Graph& graph, std::string_view name, const ComputeProgram& program,
                                  std::source_location where = std::source_location::current());

}  // namespace lensgraph::rendergraph
