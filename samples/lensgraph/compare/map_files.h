// The maps of a comparison as files: where the pictures differ from the reference, and the masks.
#pragma once

#include <filesystem>
#include <vector>

#include "engine/image/image.h"
#include "samples/lensgraph/compare/comparison.h"

namespace lensgraph::cli {

/// Throws engine::Error unless the folder is there and takes files, or can be made. Leaves nothing behind.
void checkMapFolder(const std::filesystem::path& folder);

/// Writes into the folder, which is made if it is missing, for each picture NAME (its file's name without extension; a second one of that name is NAME_2):
/// NAME.flip.png and NAME.hdr_flip.png (coloured), NAME.flip.exr and NAME.hdr_flip.exr (values), NAME.difference.png; and
/// for each mask mask.NAME.png. Precondition: the comparison keeps its maps. Throws engine::Error: a file cannot be written,
/// or is one of those compared.
void writeMaps(const Comparison& comparison, const std::filesystem::path& folder);

/// A map of values in [0,1] in matplotlib's colours "magma", from black (0) over violet and orange to pale yellow (1), as
/// FLIP's authors draw it; a linear picture to be written as PNG. Precondition: one channel.
engine::FloatImage magmaPicture(const engine::FloatImage& map);

}  // namespace lensgraph::cli
