// What a recording may do: finds the Vulkan objects behind handles, and refuses what the pass did not declare.
#include "rendergraph/pass_context.h"

#include <algorithm>
#include <string>

#include "rendergraph/declare/names.h"
#include "rendergraph/declare/subresources.h"
#include "rendergraph/execute/frame/step_state.h"

namespace lensgraph::rendergraph {

namespace {

/// Checks in the name of one pass.
class Access {
 public:
  Access(const Declaration& declaration, uint32_t pass) : declaration_(declaration), pass_(pass) {}

  /// Index of a resource that the pass declared in any way.
  template <class Tag>
  uint32_t any(const Handle<Tag>& handle) const {
    const uint32_t resource = indexOf(handle);
    for (const DeclaredAccess& access : declaration_.accessesOfPass(pass_)) {
      if (access.resource == resource) return resource;
    }
    fail(Misuse::undeclaredAccess, resource, "the recording uses it, but the pass has not declared it",
         "declare the access with sample(), read(), write() or modify()");
  }

  /// The pass's first access of this kind.
  template <class Tag>
  const DeclaredAccess& as(const Handle<Tag>& handle, Usage usage) const {
    const uint32_t resource = any(handle);
    for (const DeclaredAccess& access : declaration_.accessesOfPass(pass_)) {
      if (access.resource == resource && access.usage == usage) return access;
    }
    failUsage(resource, usage);
  }

  /// The pass's access of this kind to the range, all of which must be declared.
  const DeclaredAccess& as(const Image& handle, Usage usage, const Subresources& range) const {
    const DeclaredAccess& first = as(handle, usage);
    if (!covered(first.resource, range, [&](const DeclaredAccess& access) { return access.usage == usage; })) {
      fail(Misuse::undeclaredAccess, first.resource,
           rangeText(range) + " are bound as '" + std::string(nameOf(usage)) + "', but not all declared so",
           "bind the range that the pass declared, or declare all of it");
    }
    for (const DeclaredAccess& access : declaration_.accessesOfPass(pass_)) {
      if (access.resource == first.resource && access.usage == usage && overlap(access.range, range)) return access;
    }
    return first;
  }

  /// Whether the accesses that `counts` accepts declare every subresource of the range.
  template <class Counts>
  bool covered(uint32_t resource, const Subresources& range, Counts&& counts) const {
    const auto declares = [&](const Subresources& part) {
      for (const DeclaredAccess& access : declaration_.accessesOfPass(pass_)) {
        if (access.resource == resource && counts(access) && contains(access.range, part)) return true;
      }
      return false;
    };
    if (declares(range)) return true;
    for (uint32_t mip = range.firstMip; mip < range.firstMip + range.mipCount; ++mip) {
      for (uint32_t layer = range.firstLayer; layer < range.firstLayer + range.layerCount; ++layer) {
        if (!declares({mip, 1, layer, 1, range.aspects})) return false;
      }
    }
    return true;
  }

  /// The range with numbers, inside the image, and of one aspect when it is to be sampled.
  Subresources viewRange(uint32_t resource, Subresources range, VkImageViewType type) const {
    const ImageDesc& desc = declaration_.resources[resource].image;
    const bool chosen = range.aspects != 0;
    range = resolved(range, desc);
    if (!inside(range, desc)) {
      fail(Misuse::subresourceRange, resource, rangeText(range) + " are not inside the image",
           "name mips, layers and aspects that the image has");
    }
    if (!chosen && (range.aspects & VK_IMAGE_ASPECT_DEPTH_BIT) != 0) range.aspects = VK_IMAGE_ASPECT_DEPTH_BIT;
    if (type == VK_IMAGE_VIEW_TYPE_2D && range.layerCount > 1) {
      fail(Misuse::subresourceRange, resource,
           "a view of type 2D cannot show " + std::to_string(range.layerCount) + " layers",
           "name one layer, or use VK_IMAGE_VIEW_TYPE_2D_ARRAY");
    }
    return range;
  }

  [[noreturn]] void fail(Misuse misuse, uint32_t resource, std::string reason, std::string remedy) const {
    throw GraphError({declaration_.problem(misuse, pass_, resource, std::move(reason), std::move(remedy),
                                           declaration_.passes[pass_].where)});
  }

 private:
  template <class Tag>
  uint32_t indexOf(const Handle<Tag>& handle) const {
    return declaration_.indexOf(handle, pass_, declaration_.passes[pass_].where);
  }
  [[noreturn]] void failUsage(uint32_t resource, Usage usage) const {
    fail(Misuse::undeclaredAccess, resource,
         "the recording uses it as '" + std::string(nameOf(usage)) + "', which the pass has not declared",
         "declare this usage too");
  }
  static std::string rangeText(const Subresources& range) {
    return "mips " + std::to_string(range.firstMip) + "+" + std::to_string(range.mipCount) + ", layers " +
           std::to_string(range.firstLayer) + "+" + std::to_string(range.layerCount);
  }

  const Declaration& declaration_;
  uint32_t pass_;
};

}  // namespace

/// What the functions of PassContext share: the frame, the step, and the checks in the name of its pass.
struct PassContext::Inside {
  explicit Inside(const PassContext& context)
      : frame(context.step_.frame),
        access(*frame.declaration, context.pass_),
        commands(context.step_.commands),
        bindings(context.step_.bindings) {}

  /// Commands are recorded by every pass but host passes.
  const CommandStream& recording(uint32_t pass) const {
    if (frame.declaration->passes[pass].kind == PassKind::host) {
      access.fail(Misuse::undeclaredAccess, kNone, "a host pass records no commands",
                  "make it a compute, raster or transfer pass");
    }
    return commands;
  }

  ResolvedBinding resolve(const Binding& binding) const {
    ResolvedBinding result{};
    result.kind = binding.kind;
    switch (binding.kind) {
      case Binding::Kind::sampledImage:
      case Binding::Kind::storageImage: {
        const bool sampling = binding.kind == Binding::Kind::sampledImage;
        const Usage usage = sampling ? Usage::sampled : Usage::storage;
        const uint32_t resource = access.any(binding.image);
        const Subresources range = access.viewRange(resource, binding.range, binding.viewType);
        if (!sampling && range.mipCount != 1) {
          access.fail(Misuse::subresourceRange, resource, "a storage image binding shows one mip", "name one mip");
        }
        result.layout = access.as(binding.image, usage, range).layout;
        result.view = frame.viewOf(resource, range, binding.viewType);
        result.sampler = binding.sampler;
        break;
      }
      case Binding::Kind::storageBuffer:
        result.buffer = frame.objects[access.as(binding.buffer, Usage::storage).resource].buffer;
        break;
      case Binding::Kind::uniformBuffer:
        result.buffer = frame.objects[access.as(binding.buffer, Usage::uniform).resource].buffer;
        break;
    }
    return result;
  }

  std::span<const ResolvedBinding> resolve(std::span<const Binding> bound) const {
    bindings.clear();
    for (const Binding& binding : bound) bindings.push_back(resolve(binding));
    return bindings;
  }

  const ImageDesc& desc(const DeclaredAccess& declared) const {
    return frame.declaration->resources[declared.resource].image;
  }
  VkDeviceSize bytes(const DeclaredAccess& declared) const {
    return frame.declaration->resources[declared.resource].buffer.size;
  }

  RecordingContext& frame;
  Access access;
  const CommandStream& commands;
  std::vector<ResolvedBinding>& bindings;
};

CommandStream PassContext::commands() const {
  return step_.commands;
}

VkImage PassContext::image(Image image) const {
  const Inside inside(*this);
  return inside.frame.objects[inside.access.any(image)].image;
}

VkImageView PassContext::view(Image image, Subresources range, VkImageViewType type) const {
  const Inside inside(*this);
  const uint32_t resource = inside.access.any(image);
  const Subresources seen = inside.access.viewRange(resource, range, type);
  if (!inside.access.covered(resource, seen, [](const DeclaredAccess&) { return true; })) {
    inside.access.fail(Misuse::undeclaredAccess, resource, "the view shows subresources that the pass has not declared",
                       "view the declared range, or declare all of it");
  }
  return inside.frame.viewOf(resource, seen, type);
}

VkBuffer PassContext::buffer(Buffer buffer) const {
  const Inside inside(*this);
  return inside.frame.objects[inside.access.any(buffer)].buffer;
}

std::span<std::byte> PassContext::mapped(Buffer buffer) const {
  const Inside inside(*this);
  const DeclaredAccess& declared = inside.access.as(buffer, Usage::host);
  std::byte* address = inside.frame.objects[declared.resource].address;
  if (address == nullptr) return {};  // Imported: the host knows where it is.
  return {address, static_cast<std::size_t>(inside.bytes(declared))};
}

VkExtent2D PassContext::extent(Image image, uint32_t mipLevel) const {
  const Inside inside(*this);
  return mipExtent(inside.frame.declaration->resources[inside.access.any(image)].image, mipLevel);
}

std::span<const VkFormat> PassContext::colorFormats() const {
  return step_.colorFormats;
}

VkFormat PassContext::depthFormat() const {
  return step_.depthFormat;
}

VkSampleCountFlagBits PassContext::samples() const {
  return step_.samples;
}

void PassContext::dispatch(const Dispatch& dispatch) {
  const Inside inside(*this);
  const CommandStream& commands = inside.recording(pass_);
  VkBuffer indirect = VK_NULL_HANDLE;
  if (dispatch.indirect) {
    indirect = inside.frame.objects[inside.access.as(dispatch.indirect, Usage::indirect).resource].buffer;
  }
  inside.frame.backend.dispatch(commands, {.program = dispatch.program,
                                           .bindings = inside.resolve(dispatch.bindings),
                                           .pushConstants = dispatch.pushConstants,
                                           .specialization = dispatch.specialization,
                                           .groups = dispatch.groups,
                                           .indirect = indirect,
                                           .indirectOffset = dispatch.indirectOffset});
}

void PassContext::draw(const Draw& draw) {
  const Inside inside(*this);
  const CommandStream& commands = inside.recording(pass_);
  if (inside.frame.declaration->passes[pass_].kind != PassKind::raster) {
    inside.access.fail(Misuse::undeclaredAccess, kNone, "only a raster pass can draw",
                       "add the pass with PassKind::raster");
  }
  inside.frame.backend.draw(commands, {.program = draw.program,
                                       .bindings = inside.resolve(draw.bindings),
                                       .pushConstants = draw.pushConstants,
                                       .specialization = draw.specialization,
                                       .vertexCount = draw.vertexCount,
                                       .instanceCount = draw.instanceCount,
                                       .renderArea = step_.planned->renderArea,
                                       .colorFormats = step_.colorFormats,
                                       .depthFormat = step_.depthFormat,
                                       .samples = step_.samples});
}

void PassContext::copyImage(Image from, Image to) {
  const Inside inside(*this);
  const DeclaredAccess& source = inside.access.as(from, Usage::transferSource);
  const DeclaredAccess& target = inside.access.as(to, Usage::transferDestination);
  const Subresources &a = source.range, &b = target.range;
  for (uint32_t i = 0; i < a.mipCount; ++i) {
    const VkExtent2D extent = mipExtent(inside.desc(source), a.firstMip + i);
    const VkExtent2D other = mipExtent(inside.desc(target), b.firstMip + i);
    if (a.mipCount != b.mipCount || a.layerCount != b.layerCount || extent.width != other.width ||
        extent.height != other.height ||
        texelSize(inside.desc(source).format) != texelSize(inside.desc(target).format)) {
      inside.access.fail(Misuse::sizeMismatch, target.resource, "the copy's source has another size or texel size",
                         "declare ranges of equal extent, mips and layers, in formats of equal texel size");
    }
    VkImageCopy region{};
    region.srcSubresource = {a.aspects, a.firstMip + i, a.firstLayer, a.layerCount};
    region.dstSubresource = {b.aspects, b.firstMip + i, b.firstLayer, b.layerCount};
    region.extent = {extent.width, extent.height, 1};
    inside.frame.backend.copyImage(inside.recording(pass_), inside.frame.objects[source.resource].image,
                                   inside.frame.objects[target.resource].image, region);
  }
}

void PassContext::copyImageToBuffer(Image from, Buffer to) {
  const Inside inside(*this);
  const DeclaredAccess& source = inside.access.as(from, Usage::transferSource);
  const DeclaredAccess& target = inside.access.as(to, Usage::transferDestination);
  const VkExtent2D extent = mipExtent(inside.desc(source), source.range.firstMip);
  const VkDeviceSize bytes = VkDeviceSize{extent.width} * extent.height * texelSize(inside.desc(source).format);
  if (bytes > inside.bytes(target)) {
    inside.access.fail(
        Misuse::sizeMismatch, target.resource,
        "the image has " + std::to_string(bytes) + " bytes, the buffer " + std::to_string(inside.bytes(target)),
        "make the buffer large enough");
  }
  VkImageAspectFlags aspects = source.range.aspects;
  if ((aspects & VK_IMAGE_ASPECT_DEPTH_BIT) != 0) aspects = VK_IMAGE_ASPECT_DEPTH_BIT;  // One aspect per copy.
  VkBufferImageCopy region{};
  region.imageSubresource = {aspects, source.range.firstMip, source.range.firstLayer, 1};
  region.imageExtent = {extent.width, extent.height, 1};
  inside.frame.backend.copyImageToBuffer(inside.recording(pass_), inside.frame.objects[source.resource].image,
                                         inside.frame.objects[target.resource].buffer, region);
}

void PassContext::copyBuffer(Buffer from, Buffer to, VkDeviceSize bytes) {
  const Inside inside(*this);
  const DeclaredAccess& source = inside.access.as(from, Usage::transferSource);
  const DeclaredAccess& target = inside.access.as(to, Usage::transferDestination);
  if (bytes > inside.bytes(source) || bytes > inside.bytes(target)) {
    inside.access.fail(Misuse::sizeMismatch, target.resource,
                       std::to_string(bytes) + " bytes are copied, but a buffer is smaller",
                       "copy at most the smaller of the two sizes");
  }
  inside.frame.backend.copyBuffer(inside.recording(pass_), inside.frame.objects[source.resource].buffer,
                                  inside.frame.objects[target.resource].buffer, bytes);
}

void PassContext::fillBuffer(Buffer to, uint32_t word, VkDeviceSize bytes) {
  const Inside inside(*this);
  const DeclaredAccess& target = inside.access.as(to, Usage::transferDestination);
  if (bytes != VK_WHOLE_SIZE && (bytes == 0 || bytes % 4 != 0 || bytes > inside.bytes(target))) {
    inside.access.fail(
        Misuse::sizeMismatch, target.resource,
        std::to_string(bytes) + " bytes are filled of a buffer of " + std::to_string(inside.bytes(target)),
        "fill a multiple of 4 bytes, at least 4, that fit into the buffer");
  }
  inside.frame.backend.fillBuffer(inside.recording(pass_), inside.frame.objects[target.resource].buffer, word, bytes);
}

void PassContext::updateBuffer(Buffer to, std::span<const std::byte> bytes) {
  constexpr std::size_t kMostAtOnce = 65536;  // of vkCmdUpdateBuffer
  const Inside inside(*this);
  const DeclaredAccess& target = inside.access.as(to, Usage::transferDestination);
  if (bytes.empty() || bytes.size() % 4 != 0 || bytes.size() > inside.bytes(target)) {
    inside.access.fail(
        Misuse::sizeMismatch, target.resource,
        std::to_string(bytes.size()) + " bytes are written to a buffer of " + std::to_string(inside.bytes(target)),
        "write a multiple of 4 bytes, at least 4, that fit into the buffer");
  }
  const VkBuffer buffer = inside.frame.objects[target.resource].buffer;
  for (std::size_t done = 0; done < bytes.size(); done += kMostAtOnce) {
    const auto part = bytes.subspan(done, std::min(kMostAtOnce, bytes.size() - done));
    inside.frame.backend.updateBuffer(inside.recording(pass_), buffer, done, part);
  }
}

void PassContext::clearImage(Image to, const VkClearColorValue& value) {
  const Inside inside(*this);
  const DeclaredAccess& target = inside.access.as(to, Usage::transferDestination);
  const Subresources& r = target.range;
  const VkImageSubresourceRange range{r.aspects, r.firstMip, r.mipCount, r.firstLayer, r.layerCount};
  const VkImage image = inside.frame.objects[target.resource].image;
  if ((r.aspects & VK_IMAGE_ASPECT_COLOR_BIT) != 0) {
    inside.frame.backend.clearImage(inside.recording(pass_), image, value, range);
  } else {
    inside.frame.backend.clearDepthImage(inside.recording(pass_), image, value.float32[0], range);
  }
}

}  // namespace lensgraph::rendergraph
