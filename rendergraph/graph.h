// The declaration of a frame: resources, passes, what enters and what leaves.
//
//   Graph graph;
//   Image color = graph.importImage("scene color", desc, {.image = ..., .before = ..., .after = ...});
//   Image half = graph.createImage("half", {.format = VK_FORMAT_R16G16B16A16_SFLOAT, .width = w / 2, .height = h / 2});
//   compute(graph, "downsample", kDownsample).sample(color).write(half).groups(groups);  // compute_pass.h
//   Pass draw = graph.addPass("overlay", PassKind::raster);                              // any other kind of pass
//   half = draw.color(half, {.load = LoadOp::load});
//   draw.record([=](PassContext& context) { context.draw({...}); });
//   graph.exportImage(half, {.stages = ..., .access = ..., .layout = ...});
//   executor.execute(graph);
//
// A Graph is pure declaration: it makes no Vulkan calls and may be built on any thread (one thread at a time).
// Nothing is checked against the device until compile(). Several graphs may be alive at once.
#pragma once

#include <memory>
#include <source_location>
#include <string_view>

#include "rendergraph/handle.h"
#include "rendergraph/pass.h"
#include "rendergraph/resource.h"

namespace lensgraph::rendergraph {

struct Declaration;  // declare/declaration.h: the plain data that compile() reads.
class DeclarationObserver;

/// Last frame's and this frame's content of one image that lives across frames.
struct History {
  Image previous;  ///< Read only; zero in the first frame and after its description changed.
  Image next;      ///< To be written; becomes `previous` in the next frame.
};

class Graph {
 public:
  using Location = std::source_location;

  Graph();
  ~Graph();
  Graph(Graph&&) noexcept;
  Graph& operator=(Graph&&) noexcept;

  /// Forgets the declaration and keeps its memory, for the next frame. Handles made before become foreign.
  void reset();

  /// An image that lives within the frame; its content is undefined until a pass writes it. Names need not be
  /// unique; they appear in errors, dumps, captures and debuggers.
  Image createImage(std::string_view name, const ImageDesc& desc, Location where = Location::current());
  Buffer createBuffer(std::string_view name, const BufferDesc& desc, Location where = Location::current());

  /// An image of the host. Writing it counts as observable: its writers are never culled.
  Image importImage(std::string_view name, const ImageDesc& desc, const ImportedImage& imported,
                    Location where = Location::current());
  Buffer importBuffer(std::string_view name, const BufferDesc& desc, const ImportedBuffer& imported,
                      Location where = Location::current());

  /// An image or buffer that the executor keeps across frames under its name, zeroed when it is first made and
  /// whenever its description changes. The name must be unique among the persistent resources of one executor.
  /// Writing it counts as observable. Never aliased. It exists once, not once for each frame in flight: the device keeps
  /// successive frames apart, but what Executor::mapped() shows of an upload or readback buffer, later frames overwrite
  /// while the host looks. Wait for all that were submitted.
  Image persistentImage(std::string_view name, const ImageDesc& desc, Location where = Location::current());
  Buffer persistentBuffer(std::string_view name, const BufferDesc& desc, Location where = Location::current());
  /// Two persistent images that change places each frame.
  History history(std::string_view name, const ImageDesc& desc, Location where = Location::current());

  /// Makes the content observable after the frame: its passes are kept, its memory is not reused, and it is left in
  /// state `after`. A graph-made resource can be looked up with Executor::exportedImage() and exportedBuffer() until the next execute().
  void exportImage(Image image, const AccessState& after, Location where = Location::current());
  void exportBuffer(Buffer buffer, const AccessState& after, Location where = Location::current());

  Pass addPass(std::string_view name, PassKind kind, Location where = Location::current());

  /// Somebody who is told of every pass once it is declared and may add passes of its own, such as ImageTaps. From the
  /// next declared pass on, over reset(), until another one is set; null (default): nobody. The observer lives until
  /// then.
  void observe(DeclarationObserver* observer) { observer_ = observer; }
  /// Tells the observer that the declaration is complete; without an observer it does nothing.
  void finish();

  const ImageDesc& desc(Image image) const;
  const BufferDesc& desc(Buffer buffer) const;

  const Declaration& declaration() const { return *declaration_; }

 private:
  std::unique_ptr<Declaration> declaration_;
  DeclarationObserver* observer_ = nullptr;
};

}  // namespace lensgraph::rendergraph
