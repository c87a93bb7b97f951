// A backend without a device: writes down what it is asked for, counts living objects, and fails on demand.
#pragma once

#include <chrono>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "rendergraph/backend.h"
#include "rendergraph/error.h"

class FakeBackend : public rendergraph::Backend {
 public:
  std::vector<std::string> log;  ///< Commands and submissions in order.
  std::vector<VkImageMemoryBarrier2> imageBarriers;
  std::map<uint64_t, std::string> living;  ///< Objects that were made and not destroyed, by id.
  int failAfter = -1;                      ///< Creations that still succeed; -1: all.
  bool failSubmit = false;
  int submitMs = 0;  ///< What a submission takes, at least.
  uint32_t creations = 0;

  ~FakeBackend() override = default;

  rendergraph::MemoryRequirements requirements(const rendergraph::ImageDesc& desc,
                                               VkImageUsageFlags usage) const override {
    return nominal_.requirements(desc, usage);
  }
  rendergraph::MemoryRequirements requirements(const rendergraph::BufferDesc& desc,
                                               VkBufferUsageFlags usage) const override {
    return nominal_.requirements(desc, usage);
  }

  rendergraph::HeapId createHeap(const VkDeviceSize size, uint32_t, rendergraph::MemoryKind,
                                 std::string_view) override {
    const uint64_t id = create("heap");
    memory_[id].resize(size);
    return id;
  }
  void destroyHeap(rendergraph::HeapId heap) override { destroy(heap); }
  void* hostAddress(rendergraph::HeapId heap) override { return memory_[heap].data(); }
  VkImage createImage(const rendergraph::ImageDesc&, VkImageUsageFlags, rendergraph::HeapId heap, VkDeviceSize,
                      std::string_view name) override {
    return as<VkImage>(createOn(heap, "image " + std::string(name)));
  }
  void destroyImage(VkImage image) override { destroy(idOf(image)); }
  VkBuffer createBuffer(const rendergraph::BufferDesc&, VkBufferUsageFlags, rendergraph::HeapId heap, VkDeviceSize,
                        std::string_view name) override {
    return as<VkBuffer>(createOn(heap, "buffer " + std::string(name)));
  }
  void destroyBuffer(VkBuffer buffer) override { destroy(idOf(buffer)); }
  VkImageView createView(const rendergraph::ViewDesc& desc, std::string_view name) override {
    const uint64_t view = create("view " + std::string(name));
    viewed[view] = idOf(desc.image);
    return as<VkImageView>(view);
  }
  void destroyView(VkImageView view) override { destroy(idOf(view)); }

  VkCommandBuffer beginCommands() override {
    log.push_back("begin");
    return as<VkCommandBuffer>(++commandBuffers_);
  }
  void submitAndWait(VkCommandBuffer) override {
    log.push_back("submit");
    if (submitMs > 0) std::this_thread::sleep_for(std::chrono::milliseconds(submitMs));
    if (failSubmit) fail("device lost");
  }
  void barrier(VkCommandBuffer, const VkDependencyInfo& dependency) override {
    log.push_back("barrier");
    for (uint32_t i = 0; i < dependency.imageMemoryBarrierCount; ++i) {
      imageBarriers.push_back(dependency.pImageMemoryBarriers[i]);
    }
  }
  void beginRendering(VkCommandBuffer, const VkRenderingInfo& info) override {
    std::string text = "rendering " + std::to_string(info.renderArea.extent.width) + "x" +
                       std::to_string(info.renderArea.extent.height) + " layers " + std::to_string(info.layerCount);
    for (uint32_t i = 0; i < info.colorAttachmentCount; ++i) {
      text += " clear " + std::to_string(static_cast<int>(info.pColorAttachments[i].clearValue.color.float32[0]));
    }
    log.push_back(text);
  }
  void endRendering(VkCommandBuffer) override { log.push_back("end rendering"); }
  void beginLabel(VkCommandBuffer, std::string_view name) override { log.push_back("label " + std::string(name)); }
  void endLabel(VkCommandBuffer) override {}
  void dispatch(VkCommandBuffer, const rendergraph::ResolvedDispatch& dispatch) override {
    log.push_back("dispatch " + std::string(dispatch.program.name));
    bindings.assign(dispatch.bindings.begin(), dispatch.bindings.end());
  }
  void draw(VkCommandBuffer, const rendergraph::ResolvedDraw& draw) override {
    log.push_back("draw " + std::string(draw.program.name));
    bindings.assign(draw.bindings.begin(), draw.bindings.end());
  }
  void copyImage(VkCommandBuffer, VkImage, VkImage, const VkImageCopy& region) override {
    log.push_back("copy image mip " + std::to_string(region.srcSubresource.mipLevel));
  }
  void copyImageToBuffer(VkCommandBuffer, VkImage, VkBuffer, const VkBufferImageCopy&) override {
    log.push_back("copy image to buffer");
  }
  void copyBuffer(VkCommandBuffer, VkBuffer, VkBuffer, VkDeviceSize bytes) override {
    log.push_back("copy buffer " + std::to_string(bytes));
  }
  void fillBuffer(VkCommandBuffer, VkBuffer, uint32_t word) override { log.push_back("fill " + std::to_string(word)); }
  void clearImage(VkCommandBuffer, VkImage, const VkClearColorValue&, const VkImageSubresourceRange&) override {
    log.push_back("clear");
  }
  void clearDepthImage(VkCommandBuffer, VkImage, float, const VkImageSubresourceRange&) override {
    log.push_back("clear depth");
  }
  uint32_t maxTimestamps() const override { return 6; }
  void writeTimestamp(VkCommandBuffer, VkPipelineStageFlags2, uint32_t slot) override {
    log.push_back("timestamp " + std::to_string(slot));
  }
  void readTimestamps(std::span<double> nanoseconds) override {
    for (std::size_t i = 0; i < nanoseconds.size(); ++i) nanoseconds[i] = 1e6 * static_cast<double>(i * i);
  }

  /// How often a line is in the log.
  std::size_t count(std::string_view line) const {
    std::size_t n = 0;
    for (const std::string& entry : log) n += entry == line;
    return n;
  }
  template <class T>
  static T as(uint64_t id) {
    return reinterpret_cast<T>(id);
  }
  template <class T>
  static uint64_t idOf(T object) {
    return reinterpret_cast<uint64_t>(object);
  }

  std::vector<rendergraph::ResolvedBinding> bindings;  ///< Of the latest dispatch or draw.
  std::map<uint64_t, uint64_t> viewed;                 ///< View to image.
  std::vector<std::string> mistakes;                   ///< What no backend should be asked for.

 private:
  [[noreturn]] static void fail(const char* reason) {
    throw rendergraph::GraphError({{.misuse = rendergraph::Misuse::device,
                                    .pass = {},
                                    .resource = {},
                                    .reason = reason,
                                    .remedy = {},
                                    .where = {}}});
  }
  uint64_t create(const std::string& what) {
    if (failAfter == 0) fail("out of memory");
    if (failAfter > 0) --failAfter;
    ++creations;
    living[++lastId_] = what;
    return lastId_;
  }
  uint64_t createOn(rendergraph::HeapId heap, const std::string& what) {
    if (living.count(heap) == 0) mistakes.push_back(what + " on a dead heap");
    const uint64_t id = create(what);
    parents_[id] = heap;
    return id;
  }
  void destroy(uint64_t id) {
    if (living.erase(id) == 0) mistakes.push_back("destroyed twice, or never made");
    for (const auto& [child, parent] : parents_) {
      if (parent == id && living.count(child) != 0) mistakes.push_back("heap destroyed before " + living[child]);
    }
    for (const auto& [view, image] : viewed) {
      if (image == id && living.count(view) != 0) mistakes.push_back("image destroyed before its view");
    }
  }

  rendergraph::NominalDevice nominal_;
  std::map<uint64_t, std::vector<std::byte>> memory_;
  std::map<uint64_t, uint64_t> parents_;
  uint64_t lastId_ = 1000;
  uint64_t commandBuffers_ = 0;
};
