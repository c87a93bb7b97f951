// What --capture, --trace and --dump-image ask for: checked, measured, written. Shared by render and apply.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "engine/vulkan/device.h"
#include "rendergraph/image_tap.h"
#include "samples/host/renderer.h"
#include "samples/host/technique_choice.h"
#include "samples/lensgraph/capture/capture_file.h"
#include "samples/lensgraph/output.h"
#include "samples/lensgraph/subcommands.h"

namespace lensgraph::cli {

/// One --dump-image. Throws engine::Error (bad input) unless it reads PASS/RESOURCE=FILE or
/// PASS/RESOURCE[MIP,LAYER]=FILE; the first slash ends the pass, the first equals sign the image.
struct ImageDump {
  explicit ImageDump(const std::string& argument);
  std::string image;  ///< As given, without the file.
  rendergraph::ImageTap tap;
  std::filesystem::path file;
};

class Looks {
 public:
  /// Checks everything that can be checked without a device. Throws engine::Error (bad input).
  explicit Looks(const LookArguments& arguments);

  /// The files that write() will write.
  std::vector<OutputFile> outputs() const;
  /// Only the list of images is wanted, which printList() prints after render().
  bool listsOnly() const { return lists_; }
  void printList() const;

  using RenderOnce = std::function<host::Rendering(const host::RenderOptions& options)>;
  /// The picture. With something to measure: a warm-up frame (shaders are compiled in it), then the measured ones, each
  /// isolated one beside the same frame in one piece, and one more when images are dumped, whose copies would disturb
  /// the measurement. Throws what `renderOnce` throws, and
  /// engine::Error (bad input) when a dump matches nothing: nothing is written then.
  host::Rendering render(const engine::DeviceDescription& device, host::RenderOptions options,
                         const RenderOnce& renderOnce);
  /// Writes what was asked for.
  void write(const engine::DeviceDescription& device, const CaptureInput& input, const host::TechniqueChoice& choice,
             const host::Rendering& rendering) const;

 private:
  host::Rendering measure(host::RenderOptions options, const RenderOnce& renderOnce);
  void requireMatches() const;

  const LookArguments& arguments_;
  bool lists_ = false;
  std::vector<ImageDump> dumps_;
  std::optional<Measurement> measurement_;
  host::Tapped tapped_;
};

}  // namespace lensgraph::cli
