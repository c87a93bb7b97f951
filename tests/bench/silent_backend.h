// The unit tests' backend without its diary, so that what is measured is the executor.
#pragma once

#include "fake_backend.h"

namespace bench {

class SilentBackend : public FakeBackend {
 public:
  rendergraph::HeapId createHeap(const VkDeviceSize, uint32_t bits, rendergraph::MemoryKind kind,
                                 std::string_view name) override {
    return FakeBackend::createHeap(1, bits, kind, name);  // Nothing is ever stored.
  }
  VkCommandBuffer beginCommands() override { return as<VkCommandBuffer>(1); }
  void submitAndWait(VkCommandBuffer) override {}
  void barrier(VkCommandBuffer, const VkDependencyInfo&) override {}
  void beginLabel(VkCommandBuffer, std::string_view) override {}
  void endLabel(VkCommandBuffer) override {}
};

}  // namespace bench
