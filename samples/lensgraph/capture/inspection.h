// What is wanted beside the picture: measured frames (--capture, --trace, --frames-timed) and images inside the graph
// (--dump-image).
// Shared by render and apply.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "engine/vulkan/device.h"
#include "samples/host/renderer.h"
#include "samples/host/technique_choice.h"
#include "samples/lensgraph/capture/capture_file.h"
#include "samples/lensgraph/capture/image_dumps.h"
#include "samples/lensgraph/capture/measurement.h"
#include "samples/lensgraph/output.h"
#include "samples/lensgraph/subcommands.h"

namespace lensgraph::cli {

class Inspection {
 public:
  /// Checks everything that can be checked without a device. Throws engine::Error (bad input). The arguments outlive
  /// the inspection.
  explicit Inspection(const InspectionArguments& arguments);

  /// The files that write() will write.
  std::vector<OutputFile> outputs() const;
  const ImageDumps& imageDumps() const { return dumps_; }

  /// Renders the picture. With something to measure: a warm-up frame (shaders are compiled in it), then the measured
  /// ones, and one more when images are dumped, whose copies would disturb the measurement. Frames to be timed follow
  /// last, since all that came before has warmed them up. Throws what `renderOnce`
  /// throws, and engine::Error (bad input) when a dump matches nothing: nothing is written then.
  host::Rendering render(const engine::DeviceDescription& device, host::RenderOptions options,
                         const RenderOnce& renderOnce);
  /// Of the frames of --frames-timed; empty without.
  const FrameTimes& frameTimes() const { return times_; }
  /// Writes what was asked for.
  void write(const engine::DeviceDescription& device, const CaptureInput& input, const host::TechniqueChoice& choice,
             const host::Rendering& rendering) const;

 private:
  host::Rendering renderPicture(const engine::DeviceDescription& device, host::RenderOptions options,
                                const RenderOnce& renderOnce);

  const InspectionArguments& arguments_;
  ImageDumps dumps_;
  std::optional<Measurement> measurement_;
  FrameTimes times_;
};

}  // namespace lensgraph::cli
