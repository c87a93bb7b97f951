// What the subcommands that need a device share: opening it, saying which it is, rendering with a progress
// bar, and what the validation layers said.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "engine/vulkan/device.h"
#include "samples/host/renderer.h"
#include "samples/host/technique_choice.h"
#include "samples/lensgraph/subcommands.h"

namespace lensgraph::cli {

/// "llvmpipe (LLVM 15.0.6, 256 bits), cpu, Mesa 22.3.6".
std::string describe(const engine::DeviceDescription& device);

class Session {
 public:
  /// Opens the device and says on stderr (verbose) which. Throws engine::Error.
  explicit Session(const GlobalArguments& global);

  engine::Device& device() { return *device_; }
  /// Loader warnings, each as a warning on stderr.
  static void report(const std::vector<std::string>& warnings);
  /// Exit code: 1 after telling the messages of the validation layers, 0 when there are none.
  int finish();

 private:
  std::unique_ptr<engine::Device> device_;
};

/// The files' choice overridden by the command line's. Parameters of `fromShot` are kept only when its
/// technique is. Throws engine::Error.
host::TechniqueChoice chooseTechnique(host::TechniqueChoice fromShot, const TechniqueArguments& arguments);

}  // namespace lensgraph::cli
