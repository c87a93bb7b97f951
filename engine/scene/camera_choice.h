// Which of a scene's cameras a picture is taken with, by name, by index, or because there is only one.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <variant>

#include "engine/scene/camera.h"
#include "engine/scene/scene.h"

namespace lensgraph::engine {

/// The scene's only camera, of whatever type.
struct OnlyCamera {
  bool operator==(const OnlyCamera&) const = default;
};

/// The only camera; a place in Scene::cameras, from 0; or a name: a camera's, else its node's, else, where the text is
/// digits alone, such a place.
using CameraChoice = std::variant<OnlyCamera, std::size_t, std::string>;

/// The scene's camera of that choice. Scale in its transform is ignored. `nearPlane` is in the scene's unit; none: the
/// file's. Throws Error with the field camera.gltfCamera, or camera for the only one: none is chosen, and then it lists the
/// cameras that there are, long lists shortened; it is orthographic; its field of view, near plane or transform is nonsense.
Camera cameraFromScene(const Scene& scene, const CameraChoice& choice, std::optional<double> nearPlane = {});

}  // namespace lensgraph::engine
