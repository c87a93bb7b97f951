// What a user should be told of a picture that is made but may not be what was meant. Each warning is one line that
// names the field or option to change.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "engine/image/image.h"
#include "engine/scene/camera.h"
#include "engine/scene/scene.h"
#include "passes/lens/physical_lens.h"
#include "passes/parameters.h"
#include "passes/technique.h"
#include "samples/host/rendering.h"

namespace lensgraph::host {

/// Lens fields that are set and that the technique ignores, or follows in size alone. None when depth of field is off.
std::optional<std::string> ignoredLensWarning(const passes::Lens& lens, const passes::Technique& technique);

/// Why nothing of a scene is in the picture: all of it before the near plane, behind the camera, or aside. To be asked
/// when nothing is visible.
std::string invisibleSceneWarning(const engine::Scene& scene, const engine::Camera& camera, double metersPerUnit);

/// A picture of the background alone, though something is in view whose back faces are not drawn.
std::optional<std::string> backFacesWarning(const engine::FloatImage& color, const std::array<float, 3>& background,
                                            const engine::Scene& scene);

/// A scene that is to be lit, but has no light, glows nowhere and stands in no environment.
std::optional<std::string> unlitSceneWarning(const engine::Scene& scene, bool hasEnvironment);

/// Lists that had no room for all that was drawn, and kept what is nearest.
std::optional<std::string> listRoomWarning(const shared::FrameStatistics& statistics);

/// Blur that was limited, with the limit's name: a parameter of the technique or the lens's own. `imageHeight` in px.
std::optional<std::string> limitedBlurWarning(uint32_t limitedPixels, const passes::Lens& lens,
                                              const passes::Technique& technique,
                                              const passes::ParameterSet& parameters, int imageHeight);

/// More than half of the pixels above what an 8-bit picture can show, with the exposure at which about one in a hundred
/// would be. `exposureEv` is what the picture is brightened by now.
std::optional<std::string> clippedPictureWarning(const engine::FloatImage& color, double exposureEv);

}  // namespace lensgraph::host
