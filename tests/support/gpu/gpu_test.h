// Base of every test on a device: validation and synchronization validation are on, and any message fails the test.
#pragma once

#include <gtest/gtest.h>

#include "engine/vulkan/device.h"
#include "samples/host/renderer.h"

namespace lensgraph::support {

/// The validated device of this program, made on first use.
engine::Device& device();

class GpuTest : public testing::Test {
 protected:
  void TearDown() override;
};

/// The picture of a technique; fails the test with the message when rendering throws.
host::Rendering render(host::Renderer& renderer, const host::Shot& shot, const std::string& technique,
                       const passes::ParameterSet& parameters = {});

/// Channel values that are neither finite, in a picture.
std::size_t nonFiniteCount(const engine::FloatImage& picture);

/// Writes a PNG into the folder named by the environment variable LENSGRAPH_TEST_PICTURES, if set: to look at.
void keepPicture(const engine::FloatImage& picture, const std::string& name);

}  // namespace lensgraph::support
