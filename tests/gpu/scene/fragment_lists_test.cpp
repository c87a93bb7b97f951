// Sorting and compacting of linked lists against the host's, for lists of every length, in every order of arrival.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <glm/gtc/packing.hpp>
#include <random>
#include <tuple>

#include "engine/graph/graph_backend.h"
#include "passes/multilayer_filtering/nodes.h"
#include "passes/nodes/statistics.h"
#include "shaders/shared/statistics.h"
#include "spirv/test/heads_comp.h"
#include "tests/support/gpu/device_buffers.h"
#include "tests/support/gpu/gpu_test.h"

namespace lensgraph {

namespace {

namespace multilayer = passes::multilayer_filtering;
using rendergraph::Usage;
using shared::FragmentNode;

const rendergraph::ComputeProgram kHeads{"test.heads", test_heads_comp};

/// A fragment as a test gives it: by its depth buffer's value, colour, alpha and flags.
struct Fragment {
  float z = 0.0f;
  uint32_t redGreen = 0, blueAlpha = 0, flags = 0;
  auto order() const { return std::tuple(-z, redGreen, blueAlpha, flags); }
};
using Lists = std::vector<std::vector<Fragment>>;

/// What level 0 holds of a list.
struct Compacted {
  float vergence;
  uint32_t redGreen, blueAlpha;
  bool operator==(const Compacted&) const = default;
};
using CompactedLists = std::vector<std::vector<Compacted>>;

constexpr uint32_t kWidth = 16;
constexpr float kScale = 4.0f;  // vergence of a depth buffer's value

uint32_t halves(float a, float b) {
  return glm::packHalf1x16(a) | uint32_t{glm::packHalf1x16(b)} << 16;
}

Fragment randomFragment(std::mt19937& random) {
  const auto number = [&] { return static_cast<float>(random() % 64) / 16.0f; };
  Fragment fragment;
  fragment.z = static_cast<float>(random() % 200) / 200.0f;  // ties are frequent
  fragment.redGreen = halves(number(), number());
  fragment.blueAlpha = halves(number(), 1.0f);  // opaque, so that premultiplying changes nothing
  fragment.flags = (random() % 2 ? shared::kFragmentSolid : 0u) | (random() % 2 ? shared::kFragmentFacesAway : 0u);
  return fragment;
}

CompactedLists onHost(const Lists& lists, uint32_t length, bool outer) {
  CompactedLists result;
  for (auto list : lists) {
    std::ranges::sort(list, {}, &Fragment::order);
    const std::size_t candidates = outer ? 2 * length : length;
    if (list.size() > candidates) list.resize(candidates);
    std::vector<Compacted> kept;
    int open = 0;
    for (const Fragment& fragment : list) {
      if (kept.size() == length) break;
      if (outer && (fragment.flags & shared::kFragmentSolid) != 0) {
        const bool leaves = (fragment.flags & shared::kFragmentFacesAway) != 0;
        if (leaves && open-- > 0) continue;
        if (leaves) open = 0;
        if (!leaves) ++open;
      }
      kept.push_back({kScale * fragment.z, fragment.redGreen, fragment.blueAlpha});
    }
    result.push_back(kept);
  }
  return result;
}

class FragmentLists : public support::GpuTest {
 protected:
  /// Links the lists in a random order of arrival and compacts them on the device.
  CompactedLists onDevice(const Lists& lists, uint32_t length, multilayer::Faces faces, uint32_t seed,
                          float listFragmentsPerPixel = 70.0f) {
    std::mt19937 random(seed);
    std::vector<std::pair<uint32_t, Fragment>> arrivals;
    for (uint32_t i = 0; i < lists.size(); ++i) {
      for (const Fragment& fragment : lists[i]) arrivals.emplace_back(i, fragment);
    }
    std::ranges::shuffle(arrivals, random);
    std::vector<uint32_t> heads(lists.size());
    std::vector<FragmentNode> nodes;
    for (const auto& [list, fragment] : arrivals) {
      nodes.push_back({.redGreen = fragment.redGreen,
                       .blueAlpha = fragment.blueAlpha,
                       .vergence = std::bit_cast<uint32_t>(fragment.z),
                       .next = heads[list] | fragment.flags});
      heads[list] = static_cast<uint32_t>(nodes.size());
    }
    nodes.resize(nodes.size() + lists.size() + 1);

    passes::SceneDraw scene;
    scene.listFragmentsPerPixel = listFragmentsPerPixel;
    multilayer::FramePlan plan;
    plan.inputs.extent = {kWidth, static_cast<uint32_t>(lists.size()) / kWidth};
    plan.inputs.lens = {.cocScale = 1.0f,
                        .focusVergence = 0.0f,
                        .maxCocRadius = 1e30f,
                        .vergenceScale = kScale,
                        .vergenceOffset = 0.0f};
    plan.inputs.scene = &scene;
    plan.parameters.listLength = static_cast<int>(length);
    plan.parameters.faces = faces;
    plan.levels = multilayer::planLevels({.extent = plan.inputs.extent});

    const support::FilledBuffer headBuffer(std::as_bytes(std::span(heads)));
    const support::FilledBuffer nodeBuffer(std::as_bytes(std::span(nodes)));
    const support::FilledBuffer allocator(std::as_bytes(std::span<const uint32_t>(heads).first(1)));
    engine::GraphBackend backend(support::device());
    rendergraph::Executor executor(backend);
    rendergraph::Graph graph;
    multilayer::LinkedLists linked;
    linked.heads = declareHeads(graph, headBuffer.importInto(graph, "heads"), plan.inputs.extent);
    linked.nodes = nodeBuffer.importInto(graph, "nodes");
    linked.allocator = allocator.importInto(graph, "allocator");
    auto counters = passes::declareStatistics(graph, "test");
    const auto compacted = multilayer::declareCompact(graph, plan, linked, counters);
    const auto ranges = support::declareReadBack(graph, compacted.lists);
    const auto vergences = support::declareReadBack(graph, compacted.vergences);
    const auto colors = support::declareReadBack(graph, compacted.colors);
    const auto countersBack = support::declareReadBack(graph, counters);
    executor.execute(graph);
    statistics = support::contentOf<shared::FrameStatistics>(executor, countersBack).front();
    const auto range = support::contentOf<uint32_t>(executor, ranges);
    const auto vergence = support::contentOf<float>(executor, vergences);
    const auto color = support::contentOf<shared::uvec2>(executor, colors);
    CompactedLists result(lists.size());
    const auto room = static_cast<uint32_t>(vergence.size());
    for (std::size_t i = 0; i < lists.size(); ++i) {
      for (uint32_t k = std::min(range[i], room); k < std::min(range[i + 1], room); ++k) {
        result[i].push_back({vergence[k], color[k].x, color[k].y});
      }
    }
    return result;
  }

  static rendergraph::Image declareHeads(rendergraph::Graph& graph, rendergraph::Buffer values, VkExtent2D extent) {
    auto heads =
        graph.createImage("heads", {.format = VK_FORMAT_R32_UINT, .width = extent.width, .height = extent.height});
    auto fill = graph.addPass("fill heads", rendergraph::PassKind::compute);
    fill.read(values, Usage::storage);
    heads = fill.write(heads, Usage::storage);
    fill.record([=](rendergraph::PassContext& context) {
      const std::array bindings = {rendergraph::storage(values), rendergraph::storage(heads)};
      context.dispatch(
          {.program = kHeads, .bindings = bindings, .groups = {.x = (extent.width * extent.height + 63) / 64}});
    });
    return heads;
  }

  shared::FrameStatistics statistics{};
};

TEST_F(FragmentLists, AreSortedAndCompactedAsOnTheHost) {
  std::mt19937 random(1);
  Lists lists(kWidth * 7);
  for (std::size_t i = 0; i < lists.size(); ++i) {
    const std::size_t length = i < 12 ? i : i % 16 == 0 ? 1000 : random() % 40;
    for (std::size_t k = 0; k < length; ++k) lists[i].push_back(randomFragment(random));
  }
  for (const uint32_t length : {1u, 2u, 4u, 16u}) {
    for (const auto faces : {multilayer::Faces::all, multilayer::Faces::outer}) {
      const auto expected = onHost(lists, length, faces == multilayer::Faces::outer);
      for (const uint32_t seed : {1u, 2u}) {
        EXPECT_TRUE(onDevice(lists, length, faces, seed) == expected) << length << " " << static_cast<int>(faces);
        EXPECT_EQ(statistics.unsortedLists, 0u);
      }
    }
  }
}

TEST_F(FragmentLists, AllListsMayBeEmptyOrEqual) {
  EXPECT_TRUE(onDevice(Lists(kWidth), 4, multilayer::Faces::all, 1) == CompactedLists(kWidth));
  std::mt19937 random(3);
  const Lists equal(kWidth, std::vector<Fragment>(9, randomFragment(random)));
  EXPECT_TRUE(onDevice(equal, 4, multilayer::Faces::all, 1) == onHost(equal, 4, false));
}

// Too long to be sorted within what a device lets a loop do: said, not silently wrong; nothing is read out of bounds.
TEST_F(FragmentLists, ListsThatAreTooLongToSortAreCounted) {
  std::mt19937 random(4);
  Lists lists(kWidth);
  for (int i = 0; i < 70000; ++i) lists[5].push_back(randomFragment(random));
  const auto compacted = onDevice(lists, 4, multilayer::Faces::all, 1);
  EXPECT_EQ(statistics.unsortedLists, 1u);
  EXPECT_EQ(compacted[5].size(), 4u);
}

// Room for less than there is: the first lists are whole, what is beyond is left out, and counted when a picture is made.
TEST_F(FragmentLists, ListsThatFindNoRoomAreLeftOut) {
  std::mt19937 random(5);
  Lists lists(kWidth * 4);
  for (auto& list : lists) {
    for (int i = 0; i < 3; ++i) list.push_back(randomFragment(random));
  }
  auto expected = onHost(lists, 4, false);
  const auto compacted = onDevice(lists, 4, multilayer::Faces::all, 1, 1.5f);
  for (std::size_t i = 0; i < lists.size(); ++i) {
    if (i >= lists.size() / 2) expected[i].clear();
    EXPECT_TRUE(compacted[i] == expected[i]) << i;
  }
}

}  // namespace

}  // namespace lensgraph
