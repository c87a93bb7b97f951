// A small graph on a device that Lensgraph makes, beside whatever Vulkan the host itself has.
#pragma once

/// Fills a buffer on the first usable device, copies it and checks the bytes that come back. True when they are right,
/// and when there is no usable device, which it then prints. Throws what Lensgraph throws.
bool fillAndReadBack();
