// Matching taps to passes, and the transfer passes that make the copies.
#include "rendergraph/image_tap.h"

#include <algorithm>

#include "rendergraph/declare/declaration.h"
#include "rendergraph/declare/subresources.h"
#include "rendergraph/graph.h"

namespace lensgraph::rendergraph {

namespace {

constexpr AccessState kHostRead{VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT, VK_IMAGE_LAYOUT_UNDEFINED};

bool copyable(const DeclaredResource& resource) {
  if (!resource.isImage || resource.image.samples != VK_SAMPLE_COUNT_1_BIT) return false;
  if (texelSize(resource.image.format) == 0) return false;
  return !resource.imported() || (resource.importedImageUsage & VK_IMAGE_USAGE_TRANSFER_SRC_BIT) != 0;
}

/// One aspect, which is what one copy takes.
VkImageAspectFlags copiedAspect(const DeclaredResource& resource) {
  for (const VkImageAspectFlags aspect : {VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_ASPECT_DEPTH_BIT}) {
    if ((resource.aspects & aspect) != 0) return aspect;
  }
  return VK_IMAGE_ASPECT_STENCIL_BIT;
}

Subresources rangeOf(const ImageTap& tap, VkImageAspectFlags aspect) {
  return {.firstMip = tap.mip, .mipCount = 1, .firstLayer = tap.layer, .layerCount = 1, .aspects = aspect};
}

}  // namespace

void ImageTaps::declarationReset() {
  images_.assign(taps_.size(), {});
  firstOpen_ = 0;
  following_ = false;
}

void ImageTaps::passesDeclared(Graph& graph, bool complete) {
  if (following_) return;  // The copies are passes and exports too.
  following_ = true;
  images_.resize(taps_.size());
  const auto end = static_cast<uint32_t>(graph.declaration().passes.size());
  for (uint32_t pass = firstOpen_; pass < end; ++pass) followPass(graph, pass);
  if (complete) firstOpen_ = static_cast<uint32_t>(graph.declaration().passes.size());
  following_ = false;
}

void ImageTaps::followPass(Graph& graph, uint32_t pass) {
  const Declaration& declaration = graph.declaration();
  for (std::size_t i = 0; i < taps_.size(); ++i) {
    if (images_[i].buffer || declaration.passes[pass].name != taps_[i].pass) continue;
    uint32_t found = kNone;
    for (const DeclaredAccess& access : declaration.accessesOfPass(pass)) {
      const DeclaredResource& resource = declaration.resources[access.resource];
      if (!access.writes() || resource.name != taps_[i].resource || !copyable(resource)) continue;
      if (overlap(access.range, rangeOf(taps_[i], copiedAspect(resource)))) found = access.resource;
    }
    if (found != kNone) copy(graph, i, found);
  }
}

void ImageTaps::copy(Graph& graph, std::size_t tap, uint32_t index) {
  // Copied: what follows adds to the declaration's arrays.
  const DeclaredResource resource = graph.declaration().resources[index];
  const ImageTap& wanted = taps_[tap];
  const VkExtent2D extent = mipExtent(resource.image, wanted.mip);
  const VkImageAspectFlags aspect = copiedAspect(resource);
  const std::string name = "tap " + wanted.pass + "/" + wanted.resource;
  const Image image{.resource = index, .version = resource.version, .graph = graph.declaration().serial};
  images_[tap] = {.buffer = graph.createBuffer(
                      name, {.size = VkDeviceSize{extent.width} * extent.height * texelSize(resource.image.format),
                             .memory = MemoryKind::readback}),
                  .format = resource.image.format,
                  .extent = extent,
                  .aspect = aspect};
  Buffer& buffer = images_[tap].buffer;
  Pass pass = graph.addPass(name, PassKind::transfer);
  pass.read(image, Usage::transferSource, rangeOf(wanted, aspect));
  buffer = pass.write(buffer, Usage::transferDestination);
  pass.record([image, copy = buffer](PassContext& context) { context.copyImageToBuffer(image, copy); });
  graph.exportBuffer(buffer, kHostRead);
}

std::vector<TapChoice> tappableImages(const Graph& graph) {
  const Declaration& declaration = graph.declaration();
  std::vector<TapChoice> choices;
  for (uint32_t pass = 0; pass < declaration.passes.size(); ++pass) {
    for (const DeclaredAccess& access : declaration.accessesOfPass(pass)) {
      const DeclaredResource& resource = declaration.resources[access.resource];
      if (!access.writes() || !copyable(resource)) continue;
      TapChoice choice{.pass = std::string(declaration.passes[pass].name),
                       .resource = std::string(resource.name),
                       .format = resource.image.format,
                       .width = resource.image.width,
                       .height = resource.image.height,
                       .layers = resource.image.layers,
                       .mips = resource.image.mips};
      if (std::ranges::find(choices, choice) == choices.end()) choices.push_back(std::move(choice));
    }
  }
  return choices;
}

}  // namespace lensgraph::rendergraph
