// The executor on a device, validated: several recording threads, several frames in flight, several executors, and what
// is left when everything changes a few hundred times.
#include <gmock/gmock.h>

#include <cstring>
#include <fstream>

#include "engine/graph/graph_backend.h"
#include "rendergraph/executor.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/test_scenes.h"

namespace lensgraph {

namespace {

using rendergraph::AccessState;
using rendergraph::Buffer;
using rendergraph::FrameToken;
using rendergraph::Graph;
using rendergraph::Image;
using rendergraph::MemoryKind;
using rendergraph::PassContext;
using rendergraph::PassKind;
using rendergraph::Usage;
using testing::Each;

class ExecutorOnDevice : public support::GpuTest {};

constexpr AccessState kHostRead{.stages = VK_PIPELINE_STAGE_2_HOST_BIT, .access = VK_ACCESS_2_HOST_READ_BIT};

struct ReadBack {
  Buffer before, now;
};

/// Reads what the frame before left in "kept", leaves `value` there, and reads `value` back through two more images.
ReadBack declareFrame(Graph& graph, float value, uint32_t size = 32) {
  const rendergraph::ImageDesc desc{.format = VK_FORMAT_R32_SFLOAT, .width = size, .height = size};
  const auto readBack = [&](Image image, const char* name) {
    Buffer buffer = graph.createBuffer(name, {.size = VkDeviceSize{size} * size * 4, .memory = MemoryKind::readback});
    auto pass = graph.addPass(name, PassKind::transfer);
    pass.read(image, Usage::transferSource);
    buffer = pass.write(buffer, Usage::transferDestination);
    pass.record([=](PassContext& context) { context.copyImageToBuffer(image, buffer); });
    graph.exportBuffer(buffer, kHostRead);
    return buffer;
  };
  const auto clear = [&](Image image) {
    auto pass = graph.addPass("clear", PassKind::transfer);
    image = pass.write(image, Usage::transferDestination);
    pass.record([=](PassContext& context) { context.clearImage(image, {.float32 = {value}}); });
    return image;
  };
  ReadBack result;
  const Image kept = graph.persistentImage("kept", desc);
  result.before = readBack(kept, "before");
  clear(kept);
  const Image source = clear(graph.createImage("source", desc));
  Image copy = graph.createImage("copy", desc);
  auto pass = graph.addPass("copy", PassKind::transfer);
  pass.read(source, Usage::transferSource);
  copy = pass.write(copy, Usage::transferDestination);
  pass.record([=](PassContext& context) { context.copyImage(source, copy); });
  result.now = readBack(copy, "now");
  return result;
}

std::vector<float> valuesOf(const rendergraph::Executor& executor, Buffer buffer) {
  const auto bytes = executor.mapped(buffer);
  std::vector<float> values(bytes.size() / sizeof(float));
  std::memcpy(values.data(), bytes.data(), bytes.size());
  return values;
}

/// Executes numbered frames, several in flight, and checks each when it has finished.
class NumberedFrames {
 public:
  NumberedFrames(const engine::Device& device, uint32_t framesInFlight)
      : backend_(device), executor_(backend_, {.framesInFlight = framesInFlight}), flying_(framesInFlight) {}
  ~NumberedFrames() {
    for (uint64_t i = 0; i < flying_.size(); ++i) check(flying_[(frame_ + i) % flying_.size()]);
  }

  void next(uint32_t size = 32) {
    Flying& slot = flying_[frame_ % flying_.size()];
    check(slot);
    ++frame_;
    const auto value = static_cast<float>(frame_);
    slot.before = size == size_ ? value - 1.0f : 0.0f;
    slot.now = value;
    size_ = size;
    slot.graph.reset();
    slot.buffers = declareFrame(slot.graph, value, size);
    slot.token = executor_.submit(slot.graph, {.compile = {}, .recordingThreads = 2});
    slot.flies = true;
  }
  const engine::GraphBackend& backend() const { return backend_; }

 private:
  struct Flying {
    Graph graph;
    ReadBack buffers;
    FrameToken token;
    float before = 0, now = 0;
    bool flies = false;
  };
  void check(Flying& slot) {
    if (!std::exchange(slot.flies, false)) return;
    executor_.wait(slot.token);
    EXPECT_THAT(valuesOf(executor_, slot.buffers.before), Each(slot.before));
    EXPECT_THAT(valuesOf(executor_, slot.buffers.now), Each(slot.now));
  }

  engine::GraphBackend backend_;
  rendergraph::Executor executor_;
  std::vector<Flying> flying_;
  uint64_t frame_ = 0;
  uint32_t size_ = 0;
};

/// Resident memory of this process, bytes.
std::size_t residentBytes() {
  std::ifstream statm("/proc/self/statm");
  std::size_t total = 0, resident = 0;
  statm >> total >> resident;
  return resident * 4096;
}

// ---- Threads

std::vector<float> pictureWith(engine::Device& device, const std::string& technique, uint32_t threads) {
  host::Renderer renderer(device, support::layeredScene(), std::nullopt);
  host::RenderOptions options;
  options.technique = technique;
  options.execute.recordingThreads = threads;
  if (technique == "accumulation") {
    options.parameters = {{"lensSamples", int64_t{12}}, {"viewsPerFrame", int64_t{6}}};
  }
  return renderer.render(support::smallShot(97, 61), options).color.samples;
}

TEST_F(ExecutorOnDevice, GivesTheSamePictureHoweverManyThreadsRecord) {
  // More threads than three go unvalidated: where a command buffer begins with a change of layout that is ordered after
  // a write through a chain of two barriers (write, read, change), synchronization validation 1.3.239 follows the chain
  // inside one command buffer, and not from one to the next.
  engine::Device unvalidated;
  for (const char* technique : {"accumulation", "two_pass_filter"}) {
    const auto alone = pictureWith(support::device(), technique, 1);
    for (const uint32_t threads : {2u, 3u}) {
      EXPECT_TRUE(pictureWith(support::device(), technique, threads) == alone) << technique << ", " << threads;
    }
    for (const uint32_t threads : {5u, 8u}) {
      EXPECT_TRUE(pictureWith(unvalidated, technique, threads) == alone) << technique << ", " << threads;
    }
  }
}

// ---- Frames

TEST_F(ExecutorOnDevice, EachFrameInFlightFindsWhatTheFrameBeforeLeft) {
  for (const uint32_t framesInFlight : {1u, 2u, 4u}) {
    NumberedFrames frames(support::device(), framesInFlight);
    for (int i = 0; i < 40; ++i) frames.next();
  }
}

TEST_F(ExecutorOnDevice, FramesOfChangingSizeOverlap) {
  NumberedFrames frames(support::device(), 3);
  for (uint32_t i = 0; i < 40; ++i) frames.next(16 + 8 * (i / 3 % 5));
}

TEST_F(ExecutorOnDevice, ExecutorsTakeTurnsWithFramesInFlight) {
  NumberedFrames first(support::device(), 2), second(support::device(), 3);
  for (uint32_t i = 0; i < 30; ++i) {
    first.next();
    second.next(i % 2 == 0 ? 32 : 64);
  }
}

TEST_F(ExecutorOnDevice, AGraphMovesFromOneDeviceToAnother) {
  Graph graph;
  const ReadBack buffers = declareFrame(graph, 3.5f);
  std::shared_ptr<engine::ValidationLog> log;
  {
    engine::Device another({.select = "", .validation = true});
    log = another.validationLog();
    engine::GraphBackend backend(another);
    rendergraph::Executor executor(backend);
    executor.execute(graph);
    EXPECT_THAT(valuesOf(executor, buffers.now), Each(3.5f));
  }
  EXPECT_THAT(log->messages, testing::IsEmpty());
  engine::GraphBackend backend(support::device());
  rendergraph::Executor executor(backend);
  executor.execute(graph);
  EXPECT_THAT(valuesOf(executor, buffers.before), Each(0.0f));
  EXPECT_THAT(valuesOf(executor, buffers.now), Each(3.5f));
}

// ---- What is left

TEST_F(ExecutorOnDevice, ReconfigurationsLeaveNoMemoryBehind) {
  std::size_t settled = 0;
  {
    NumberedFrames frames(support::device(), 2);
    for (uint32_t i = 0; i < 150; ++i) {
      frames.next(64 + 16 * (i * 7 % 23));
      // Three plans keep their objects, two frames fly: some MiB at most, whatever came before.
      EXPECT_LE(frames.backend().heapCount(), 24u);
      EXPECT_LE(frames.backend().allocatedBytes(), VkDeviceSize{24} << 20);
      if (i == 60) settled = residentBytes();
    }
    EXPECT_LE(residentBytes(), settled + (std::size_t{48} << 20));
  }
}

}  // namespace

}  // namespace lensgraph
