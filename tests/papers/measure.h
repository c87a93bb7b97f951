// What the programs of this folder measure: a technique's time and its distance from a reference.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "engine/image/image.h"
#include "samples/host/renderer.h"
#include "samples/host/shot.h"

namespace lensgraph::papers {

engine::FloatImage pictureOf(host::Renderer& renderer, const host::Shot& shot, const std::string& technique,
                             const passes::ParameterSet& parameters);

/// dof.exr beside the shot's file where there is one (ray-traced), else accumulation of 1024 views.
engine::FloatImage referenceOf(host::Renderer& renderer, const host::Shot& shot, const std::string& file);

/// Technique, parameters, wall time of an execution after a first one (ms), PSNR and SSIM of the displayed
/// picture. Prints them too.
nlohmann::ordered_json measure(host::Renderer& renderer, const host::Shot& shot, const std::string& technique,
                               const passes::ParameterSet& parameters, const engine::FloatImage& reference);

/// Runs a program of the form `name -o RESULT.json SHOT.json…`: `rowsOf` makes an array of rows for each shot. The result
/// says device and driver, and per shot its name, size and rows. Returns the exit status.
int run(int argc, char** argv,
        nlohmann::ordered_json (*rowsOf)(host::Renderer& renderer, const host::Shot& shot, const std::string& file));

}  // namespace lensgraph::papers
