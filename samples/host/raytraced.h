// Shots rendered by the technique `raytraced`: on the CPU, without a Vulkan device.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/draw/environment.h"
#include "engine/scene/scene.h"
#include "samples/host/rendering.h"
#include "samples/host/shot.h"

namespace lensgraph::host {

/// Whether the technique draws without a device and has no graph. Precondition: a technique of that name exists.
bool isRaytraced(std::string_view technique);

/// The shot's picture; of `options` parameters, wantDepth, progress and checkpoint count. Rendering::capture stays empty,
/// gpuMs and executions 0. Precondition: engine::findProblems(scene) is empty. Throws engine::Error (bad parameters, as
/// Renderer::render(); a checkpoint of another picture).
Rendering renderRaytraced(const engine::Scene& scene, const std::optional<engine::Environment>& environment,
                          const Shot& shot, const RenderOptions& options);

/// The same for a shot by itself: loads its scene and environment. Warnings of the loader go to `warnings`.
Rendering renderRaytraced(const Shot& shot, const RenderOptions& options, std::vector<std::string>& warnings);

/// Bad input: `what` asked for a graph, which `raytraced` has not. `field` is the option that asked.
[[noreturn]] void failWithoutGraph(const std::string& field, const std::string& what);

}  // namespace lensgraph::host
