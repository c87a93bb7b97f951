// Shader modules from SPIR-V, for the pipelines that are made of them.
#pragma once

#include <string>

#include "engine/vulkan/device.h"
#include "engine/vulkan/vulkan_api.h"
#include "rendergraph/program.h"

namespace lensgraph::engine {

/// A module is needed only until its pipeline is made. `name` appears in the error. Throws engine::Error.
Unique<VkShaderModule> makeShaderModule(const Device& device, rendergraph::SpirV code, const std::string& name);

}  // namespace lensgraph::engine
