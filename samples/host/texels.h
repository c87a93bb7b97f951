// Texels of a GPU image's format as a picture of floats.
#pragma once

#include <vulkan/vulkan_core.h>

#include <cstddef>
#include <span>

#include "engine/image/image.h"

namespace lensgraph::host {

/// The picture that tightly packed rows of texels hold; as many channels as the format has, but 3 for two (the third
/// is 0), since files have no pictures of two. Normalised integers become 0…1 (-1…1), other integers their value,
/// sRGB-encoded ones linear. Of formats with depth: the depth as stored. Throws engine::Error on block-compressed,
/// 64-bit and other rare formats, naming the format's number. Precondition: bytes for extent.width · extent.height
/// texels of `aspect` (colour, depth or stencil).
engine::FloatImage pictureOf(std::span<const std::byte> bytes, VkFormat format, VkImageAspectFlags aspect,
                             VkExtent2D extent);

}  // namespace lensgraph::host
