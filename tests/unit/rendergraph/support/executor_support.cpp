// Declares the small frames that tests of the executor run.
#include "support/executor_support.h"

namespace lensgraph::executor_test {

using namespace rendergraph;

Buffer declare(Graph& graph, const Everything& what) {
  ImageDesc desc = kDesc;
  desc.width = what.width;
  Buffer upload = graph.createBuffer("upload", {.size = 256, .memory = MemoryKind::upload});
  Buffer readback = graph.createBuffer("readback", {.size = 1 << 20, .memory = MemoryKind::readback});
  if (what.host) {
    Pass fill = graph.addPass("fill", PassKind::host);
    upload = fill.write(upload, Usage::host);
    fill.record([=](PassContext& context) { context.mapped(upload)[0] = std::byte{1}; });
  }
  Image image = graph.createImage("drawn", desc);
  Pass draw = graph.addPass("draw", PassKind::raster);
  image = draw.color(image);
  draw.record([](PassContext& context) { context.draw({.program = kRaster, .bindings = {}}); });
  for (uint32_t i = 0; i < what.passes; ++i) {
    Image next = graph.createImage("link", desc);
    Pass link = graph.addPass("link", PassKind::compute);
    link.sample(image);
    if (what.host && i == 0) link.read(upload, Usage::uniform);
    next = link.write(next, Usage::storage);
    link.record([=](PassContext& context) {
      const Binding bindings[] = {sampled(image), storage(next)};
      context.dispatch({.program = kCompute, .bindings = bindings, .groups = {}});
    });
    image = next;
  }
  if (what.history) {
    const History past = graph.history("past", desc);
    Pass blend = graph.addPass("blend", PassKind::compute);
    blend.sample(past.previous);
    blend.sample(image);
    const Image next = blend.write(past.next, Usage::storage);
    blend.record([=](PassContext& context) {
      const Binding bindings[] = {sampled(past.previous), storage(next)};
      context.dispatch({.program = kCompute, .bindings = bindings, .groups = {}});
    });
    image = next;
  }
  Pass read = graph.addPass("read", PassKind::transfer);
  read.read(image, Usage::transferSource);
  readback = read.write(readback, Usage::transferDestination);
  read.record([=](PassContext& context) { context.copyImageToBuffer(image, readback); });
  graph.exportBuffer(readback, kHostRead);
  return readback;
}

Chain declareChain(Graph& graph, float clear, uint32_t width) {
  ImageDesc desc = kDesc;
  desc.width = width;
  Image half = graph.createImage("half", desc);
  Image result = graph.createImage("result", desc);
  Pass draw = graph.addPass("draw", PassKind::raster);
  half = draw.color(half, {.clear = {{clear, 0, 0, 0}}});
  draw.record([](PassContext& context) { context.draw({.program = kRaster, .bindings = {}}); });
  Pass blur = graph.addPass("blur", PassKind::compute);
  blur.sample(half);
  result = blur.write(result, Usage::storage);
  blur.record([=](PassContext& context) {
    const Binding bindings[] = {sampled(half), storage(result)};
    context.dispatch({.program = kCompute, .bindings = bindings, .groups = {}});
  });
  graph.exportImage(result, kSampled);
  return {half, result};
}

}  // namespace lensgraph::executor_test
