// Small graphs and expectations for the tests of the plan checker.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "plan_checker/plan_checker.h"
#include "plan_checker/plan_maker.h"
#include "rendergraph/declare/declaration.h"
#include "support/test_device.h"

namespace lensgraph::plan_checker_test {

using namespace rendergraph;
using plan_checker::Hazard;

inline constexpr VkPipelineStageFlags2 kCompute = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
inline constexpr VkPipelineStageFlags2 kFragment = VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
inline constexpr VkPipelineStageFlags2 kColor = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
inline constexpr VkPipelineStageFlags2 kHost = VK_PIPELINE_STAGE_2_HOST_BIT;
inline constexpr VkAccessFlags2 kStorageWrite = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
inline constexpr VkAccessFlags2 kStorageRead = VK_ACCESS_2_SHADER_STORAGE_READ_BIT;
inline constexpr VkAccessFlags2 kSampledRead = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT;
inline constexpr VkAccessFlags2 kColorWrite = VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT;
inline constexpr VkAccessFlags2 kColorRead = VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT;
inline constexpr VkImageLayout kUndefined = VK_IMAGE_LAYOUT_UNDEFINED, kGeneral = VK_IMAGE_LAYOUT_GENERAL;
inline constexpr VkImageLayout kReadOnly = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
inline constexpr VkImageLayout kAttachment = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;

inline const ImageDesc kDesc{.format = VK_FORMAT_R8G8B8A8_UNORM, .width = 64, .height = 64};
inline const BufferDesc kBuffer{.size = 4096};
inline constexpr Subresources kWhole{0, 1, 0, 1, VK_IMAGE_ASPECT_COLOR_BIT};
inline constexpr AccessPoint kNothing{};

inline AccessPoint at(VkPipelineStageFlags2 stages, VkAccessFlags2 access = 0) {
  return {.stages = stages, .access = access};
}

inline ImageBarrier change(Image image, AccessPoint from, VkImageLayout before, AccessPoint to, VkImageLayout after) {
  return {.resource = image.resource, .range = kWhole, .from = from, .to = to, .oldLayout = before, .newLayout = after};
}

inline BufferBarrier between(Buffer buffer, AccessPoint from, AccessPoint to) {
  return {.resource = buffer.resource, .from = from, .to = to};
}

inline ImageBarrier moving(ImageBarrier barrier, BarrierReason reason, uint32_t from, uint32_t to) {
  barrier.reason = reason;
  barrier.fromQueue = from;
  barrier.toQueue = to;
  return barrier;
}

class PlanChecker : public testing::Test {
 protected:
  plan_checker::Setting setting(const Plan& plan) const { return {graph.declaration(), plan, options, device}; }

  std::vector<Hazard> hazards(const Plan& plan) const {
    std::vector<Hazard> result;
    for (const plan_checker::Finding& finding : plan_checker::findMissing(setting(plan))) {
      result.push_back(finding.hazard);
    }
    return result;
  }
  /// Nothing is missing and nothing is superfluous, so that every single weakening was found faulty.
  void expectExact(const Plan& plan, uint32_t attempts) const {
    for (const auto& finding : plan_checker::findMissing(setting(plan))) ADD_FAILURE() << finding.text;
    const plan_checker::Superfluous superfluous = plan_checker::findSuperfluous(setting(plan));
    for (const std::string& finding : superfluous.findings) ADD_FAILURE() << finding;
    EXPECT_GE(superfluous.attempts, attempts);
  }
  void expectHazard(Plan plan, const std::function<void(Plan&)>& fault, Hazard hazard) const {
    fault(plan);
    EXPECT_THAT(hazards(plan), testing::Contains(hazard));
  }

  uint32_t sampling(std::initializer_list<Image> images, const char* name = "sample",
                    PassKind kind = PassKind::compute) {
    Pass pass = graph.addPass(name, kind);
    for (Image image : images) pass.sample(image, {}, kind == PassKind::compute ? kCompute : kFragment);
    if (kind == PassKind::raster) pass.renderArea({64, 64});
    pass.sideEffect();
    return passes++;
  }
  uint32_t writing(Image& image, const char* name = "write") {
    Pass pass = graph.addPass(name, PassKind::compute);
    image = pass.write(image, Usage::storage);
    return passes++;
  }
  uint32_t drawing(Image& image, LoadOp load, Image* sampled = nullptr) {
    Pass pass = graph.addPass("draw", PassKind::raster);
    image = pass.color(image, {.load = load});
    if (sampled != nullptr) pass.sample(*sampled, {}, kFragment);
    return passes++;
  }

  Graph graph;
  CompileOptions options;
  TestDevice device{{TestDevice::kAll, TestDevice::kAsyncCompute}};
  uint32_t passes = 0;
};

}  // namespace lensgraph::plan_checker_test
