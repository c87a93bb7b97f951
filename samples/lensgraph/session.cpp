// Device, technique choice and summary shared by the rendering subcommands: see session.h.
#include "samples/lensgraph/session.h"

#include <spdlog/spdlog.h>

#include <cstdio>

#include "engine/error.h"

namespace lensgraph::cli {

std::string describe(const engine::DeviceDescription& device) {
  return device.name + ", " + device.type + ", " + device.driver;
}

Session::Session(const GlobalArguments& global)
    : device_(std::make_unique<engine::Device>(
          engine::DeviceOptions{.select = global.device, .validation = global.validation})) {
  spdlog::info("device {}", describe(device_->description()));
}

void Session::report(const std::vector<std::string>& warnings) {
  for (const auto& warning : warnings) spdlog::warn("{}", warning);
}

int Session::finish() {
  const auto& messages = device_->validationLog()->messages;
  for (const auto& message : messages) spdlog::error("validation: {}", message);
  return messages.empty() ? 0 : 1;
}

host::TechniqueChoice chooseTechnique(host::TechniqueChoice fromShot, const TechniqueArguments& arguments) {
  host::TechniqueChoice choice = std::move(fromShot);
  const auto& asked = arguments.technique;
  if (arguments.config) {
    choice = host::readTechniqueFile(*arguments.config, asked.empty() ? choice.name : asked);
    if (!asked.empty() && choice.name != asked) {
      throw engine::Error({.file = arguments.config->string(),
                           .field = "technique.name",
                           .reason = "is \"" + choice.name + "\", but --technique asks for \"" + asked + "\"",
                           .remedy = "remove one of them"});
    }
  } else if (!asked.empty() && asked != choice.name) {
    choice = {asked, {}};
  }
  host::requireTechnique(choice.name, "command line", "--technique");
  for (const auto& setting : arguments.settings) host::setParameter(choice, setting);
  return choice;
}

void printSummary(const engine::DeviceDescription& device, const host::TechniqueChoice& choice,
                  const host::Rendering& rendering) {
  std::printf("device     %s\n", describe(device).c_str());
  std::printf("technique  %s\n", choice.name.c_str());
  for (const auto& parameter : host::requireTechnique(choice.name, "", "").parameters) {
    const auto given = choice.parameters.find(parameter.name);
    const auto& value = given == choice.parameters.end() ? parameter.defaultValue : given->second;
    std::printf("           %s = %s%s%s\n", std::string(parameter.name).c_str(), passes::toString(value).c_str(),
                parameter.unit.empty() ? "" : " ", std::string(parameter.unit).c_str());
  }
  std::printf("picture    %u x %u px\n", rendering.color.width, rendering.color.height);
  if (rendering.executions > 0) {
    std::printf("time       GPU %.2f ms, wall %.2f ms\n", rendering.gpuMs, rendering.wallMs);
  } else {
    std::printf("time       wall %.2f ms\n", rendering.wallMs);  // No device took part.
  }
  if (rendering.estimatedError >= 0.0) std::printf("estimate   RMS error %.2g left\n", rendering.estimatedError);
  if (rendering.statistics.replacedTexels > 0) {
    spdlog::warn("{} texels that were not finite were replaced by 0", rendering.statistics.replacedTexels);
  }
  Session::report(rendering.warnings);
  if (rendering.statistics.transparentUnsorted > 0) {
    spdlog::warn("{} pixels have too many alpha-blended layers: the nearest ones are missing there",
                 rendering.statistics.transparentUnsorted);
  }
  if (rendering.statistics.transparentDropped > 0) {
    spdlog::warn("{} transparent fragments found no room: the picture is incomplete",
                 rendering.statistics.transparentDropped);
  }
  if (rendering.statistics.unsortedLists > 0) {
    spdlog::warn("{} pixels have too many surfaces one behind another: some are missing there",
                 rendering.statistics.unsortedLists);
  }
}

}  // namespace lensgraph::cli
