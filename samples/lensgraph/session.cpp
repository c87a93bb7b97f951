// Device and technique choice shared by the rendering subcommands: see session.h.
#include "samples/lensgraph/session.h"

#include <spdlog/spdlog.h>

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

}  // namespace lensgraph::cli
