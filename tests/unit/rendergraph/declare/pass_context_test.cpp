// What a recording may touch, and what it is told when it touches something else.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "rendergraph/executor.h"
#include "support/fake_backend.h"

namespace lensgraph {

using namespace rendergraph;
using testing::HasSubstr;

namespace {

const ComputeProgram kProgram{.name = "program", .shader = {}};
const RasterProgram kRaster{.name = "raster", .vertex = {}, .geometry = {}, .fragment = {}, .state = {}};
const ImageDesc kDesc{.format = VK_FORMAT_R16G16B16A16_SFLOAT, .width = 64, .height = 32};

Misuse misuseOf(const std::function<void()>& action, std::string* text) {
  try {
    action();
  } catch (const GraphError& error) {
    *text = error.what();
    return error.misuse();
  }
  ADD_FAILURE() << "nothing was thrown";
  return Misuse::device;
}

/// Executes one compute pass that has declared sampling of mip 0 of "seen", and writing of "out".
Misuse misuseInRecording(const std::function<void(PassContext&, Image seen, Image out, Image hidden)>& recording,
                         std::string& text) {
  FakeBackend backend;
  Executor executor(backend);
  Graph graph;
  ImageDesc desc = kDesc;
  desc.mips = 2;
  const Image seen = graph.persistentImage("seen", desc);
  const Image hidden = graph.createImage("hidden", kDesc);
  Image out = graph.persistentImage("out", {.format = kDesc.format, .width = 64, .height = 32, .layers = 2});
  Pass pass = graph.addPass("pass", PassKind::compute);
  pass.sample(seen, mip(0));
  out = pass.write(out, Usage::storage);
  pass.record([=](PassContext& context) { recording(context, seen, out, hidden); });
  const Misuse misuse = misuseOf([&] { executor.execute(graph); }, &text);
  EXPECT_EQ(backend.count("submit"), 0u);
  return misuse;
}

}  // namespace

TEST(PassContext, RefusesWhatThePassDidNotDeclare) {
  std::string text;
  const auto dispatch = [](PassContext& context, Binding binding) {
    const Binding bindings[] = {binding};
    context.dispatch({.program = kProgram, .bindings = bindings, .groups = {}});
  };
  EXPECT_EQ(misuseInRecording([&](PassContext& c, Image, Image, Image hidden) { c.image(hidden); }, text),
            Misuse::undeclaredAccess);
  EXPECT_THAT(text, HasSubstr("pass 'pass', resource 'hidden'"));
  EXPECT_THAT(text, HasSubstr("declare the access"));
  EXPECT_EQ(misuseInRecording([&](PassContext& c, Image seen, Image, Image) { dispatch(c, storage(seen)); }, text),
            Misuse::undeclaredAccess);
  EXPECT_THAT(text, HasSubstr("'storage'"));
  EXPECT_EQ(misuseInRecording([&](PassContext& c, Image seen, Image, Image) { dispatch(c, sampled(seen)); }, text),
            Misuse::undeclaredAccess);
  EXPECT_THAT(text, HasSubstr("mips 0+2"));
  EXPECT_EQ(misuseInRecording([&](PassContext& c, Image, Image out, Image) { dispatch(c, storage(out)); }, text),
            Misuse::subresourceRange);
  EXPECT_THAT(text, HasSubstr("2D_ARRAY"));
  EXPECT_EQ(misuseInRecording([&](PassContext& c, Image seen, Image, Image) { c.view(seen, mip(5)); }, text),
            Misuse::subresourceRange);
  EXPECT_EQ(misuseInRecording([&](PassContext& c, Image, Image, Image) { c.image({}); }, text), Misuse::unknownHandle);
  EXPECT_EQ(misuseInRecording(
                [&](PassContext& c, Image, Image, Image) {
                  c.image({0, 0, 1});
                },
                text),
            Misuse::foreignHandle);
  EXPECT_EQ(misuseInRecording([&](PassContext& c, Image seen, Image out, Image) { c.copyImage(seen, out); }, text),
            Misuse::undeclaredAccess);
  EXPECT_EQ(misuseInRecording(
                [&](PassContext& c, Image, Image, Image) { c.draw({.program = kRaster, .bindings = {}}); }, text),
            Misuse::undeclaredAccess);
}

TEST(PassContext, AnyVersionOfADeclaredResourceWillDo) {
  FakeBackend backend;
  Executor executor(backend);
  Graph graph;
  const Image before = graph.persistentImage("image", kDesc);
  Pass pass = graph.addPass("pass", PassKind::compute);
  const Image after = pass.modify(before, Usage::storage);
  pass.record([=](PassContext& context) { EXPECT_EQ(context.image(before), context.image(after)); });
  executor.execute(graph);
}

}  // namespace lensgraph
