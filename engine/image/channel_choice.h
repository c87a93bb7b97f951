// Which channels of a picture file are its colour, and which is its depth. Private to engine/image.
//
// A channel "ViewLayer.Depth.Z" is Z of the layer "ViewLayer.Depth". In a file of several parts, a part's name is the layer
// of its channels that name none. Letters may be in either case everywhere.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/image/image_io.h"
#include "engine/image/picture_file.h"

namespace lensgraph::engine {

/// Channels of one part, in the order in which they are wanted.
struct ChosenChannels {
  size_t part = 0;
  std::vector<size_t> channels;
  ChannelsRead names;
};

/// R, G, B and A where there is one; or one grey channel, or grey three times and A. See readImage() for the rules. Throws
/// Error that names the file and lists what there is.
ChosenChannels chooseColor(const std::filesystem::path& path, const std::vector<PicturePart>& parts,
                           const ChannelChoice& layer);

/// The channel of depth. See readDepth() for the rules. Throws Error that names the file and lists what there is.
ChosenChannels chooseDepth(const std::filesystem::path& path, const std::vector<PicturePart>& parts,
                           const ChannelChoice& channel);

}  // namespace lensgraph::engine
