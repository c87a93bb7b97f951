// Checks the JSON of a glTF file before tinygltf sees it. Private to engine/gltf.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace lensgraph::engine::gltf {

/// Puts a harmless camera in the place of each that no node refers to: what is wrong with those stops nothing. To be
/// called before checkStructure().
void dropUnusedCameras(nlohmann::json& root);

/// Throws Error naming the field for the first member of a wrong type, missing, of a wrong length, or an
/// index out of range of the array that it points into. Whole numbers written as 3.0 become integers. Knows
/// the members that engine/gltf uses; others are not looked at.
void checkStructure(nlohmann::json& root, const std::string& file);

}  // namespace lensgraph::engine::gltf
