// Makes the validated device once for all tests of a program, and fails a test on any message of the layers.
#include "tests/support/gpu/gpu_test.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>

#include "engine/image/image_io.h"

namespace lensgraph::support {
namespace {

/// Destroys the device at the end of the program's tests and checks what the layers say of that (leaked objects).
class DeviceKeeper : public testing::Environment {
 public:
  void TearDown() override {
    if (!device) return;
    const auto log = device->validationLog();
    device.reset();
    EXPECT_THAT(log->messages, testing::IsEmpty()) << "at the device's end";
  }
  std::unique_ptr<engine::Device> device;
};

DeviceKeeper& keeper() {
  static auto* const kept =
      static_cast<DeviceKeeper*>(testing::AddGlobalTestEnvironment(new DeviceKeeper));  // gtest owns and deletes it
  return *kept;
}

// Environments must be known before the tests run.
[[maybe_unused]] const auto& kRegistered = keeper();

}  // namespace

engine::Device& device() {
  auto& slot = keeper().device;
  if (!slot) slot = std::make_unique<engine::Device>(engine::DeviceOptions{.select = "", .validation = true});
  return *slot;
}

void GpuTest::TearDown() {
  auto& messages = device().validationLog()->messages;
  EXPECT_THAT(messages, testing::IsEmpty());
  messages.clear();
}

host::Rendering render(host::Renderer& renderer, const host::Shot& shot, const std::string& technique,
                       const passes::ParameterSet& parameters) {
  host::RenderOptions options;
  options.technique = technique;
  options.parameters = parameters;
  try {
    return renderer.render(shot, options);
  } catch (const std::exception& error) {
    ADD_FAILURE() << technique << ": " << error.what();
    host::Rendering nothing;
    nothing.color = engine::FloatImage(static_cast<uint32_t>(shot.width), static_cast<uint32_t>(shot.height), 4);
    return nothing;
  }
}

std::size_t nonFiniteCount(const engine::FloatImage& picture) {
  return static_cast<std::size_t>(
      std::count_if(picture.samples.begin(), picture.samples.end(), [](float v) { return !std::isfinite(v); }));
}

void keepPicture(const engine::FloatImage& picture, const std::string& name) {
  const char* folder = std::getenv("LENSGRAPH_TEST_PICTURES");
  if (folder != nullptr) engine::writeImage(std::filesystem::path(folder) / (name + ".png"), picture);
}

}  // namespace lensgraph::support
