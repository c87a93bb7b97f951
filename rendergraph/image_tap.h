// A look at any pass's output image: copies it, as it is right after that pass, into memory that the host can read.
//
//   ImageTaps taps;
//   taps.add({.pass = "bloom.down", .resource = "bloom.half", .mip = 2});
//   graph.observe(&taps);                       // before declaring; stays over Graph::reset()
//   ... declare the frame ...
//   graph.finish();
//   executor.execute(graph);
//   const TappedImage& copy = taps.images()[0];
//   if (copy.buffer) use(executor.mapped(copy.buffer), copy.format, copy.extent);
//
// A tap is nothing but a transfer pass that the graph appends behind the tapped one, with an exported readback buffer.
// So the tapped pass is not culled, memory is not reused too early, and barriers are right, by the same rules as for
// every other pass. It changes the plan: measure frames without taps.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "rendergraph/declaration_observer.h"
#include "rendergraph/handle.h"
#include "rendergraph/resource.h"

namespace lensgraph::rendergraph {

/// What to copy: one mip and layer of an image that a pass writes. Of several passes with the name, the first one that
/// writes an image with that name and subresource is meant.
struct ImageTap {
  std::string pass;      ///< As given to Graph::addPass.
  std::string resource;  ///< As given to Graph::createImage and its like.
  uint32_t mip = 0;      ///< Level, 0 is the largest.
  uint32_t layer = 0;    ///< Array layer.
  bool operator==(const ImageTap&) const = default;
};

/// Where the copy of one tap lies.
struct TappedImage {
  Buffer buffer;  ///< Exported, of MemoryKind::readback; default-made when nothing in the declaration matched.
  VkFormat format = VK_FORMAT_UNDEFINED;
  VkExtent2D extent = {0, 0};  ///< Of the mip, px.
  /// What of the format was copied, in tightly packed rows: colour, depth, or (of a format with nothing else) stencil.
  /// Of a format with depth and stencil the depth alone, as Vulkan packs it in copies.
  VkImageAspectFlags aspect = 0;
};

/// An image that could be tapped.
struct TapChoice {
  std::string pass, resource;
  VkFormat format = VK_FORMAT_UNDEFINED;
  uint32_t width = 0, height = 0, layers = 1, mips = 1;
  bool operator==(const TapChoice&) const = default;
};

/// The taps of one graph; outlives its declarations. Not thread-safe. Add taps before the passes that they name.
/// A tap that matches nothing is no error: its TappedImage stays empty. Copies throw no errors of their own.
class ImageTaps final : public DeclarationObserver {
 public:
  void add(ImageTap tap) { taps_.push_back(std::move(tap)); }
  const std::vector<ImageTap>& taps() const { return taps_; }
  /// One for each tap, in order of add(); of the declaration that was finished last.
  const std::vector<TappedImage>& images() const { return images_; }

 private:
  void declarationReset() override;
  /// Appends the copies that belong behind the passes declared so far.
  void passesDeclared(Graph& graph, bool complete) override;
  void followPass(Graph& graph, uint32_t pass);
  void copy(Graph& graph, std::size_t tap, uint32_t resource);

  std::vector<ImageTap> taps_;
  std::vector<TappedImage> images_;
  uint32_t firstOpen_ = 0;  ///< Passes before it have been dealt with.
  bool following_ = false;
};

/// Every image that some pass writes and that can be copied: of one sample, of an uncompressed format, and, when it is
/// the host's, made with VK_IMAGE_USAGE_TRANSFER_SRC_BIT. In order of declaration; a pass that writes an image in
/// several accesses is told once.
std::vector<TapChoice> tappableImages(const Graph& graph);

}  // namespace lensgraph::rendergraph
