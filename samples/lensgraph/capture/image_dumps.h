// What --dump-image asks for: images inside the graph, written to files or listed.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "rendergraph/image_tap.h"
#include "samples/host/renderer.h"
#include "samples/lensgraph/output.h"

namespace lensgraph::cli {

/// One --dump-image. Throws engine::Error (bad input) unless it reads PASS/RESOURCE=FILE or
/// PASS/RESOURCE[MIP,LAYER]=FILE; the first slash ends the pass, the first equals sign the image.
struct ImageDump {
  explicit ImageDump(const std::string& argument);
  std::string image;  ///< As given, without the file.
  rendergraph::ImageTap tap;
  std::filesystem::path file;
};

class ImageDumps {
 public:
  /// `arguments`: one for each --dump-image, or "list" alone. Throws engine::Error (bad input).
  explicit ImageDumps(const std::vector<std::string>& arguments);

  bool wanted() const { return lists_ || !dumps_.empty(); }
  /// Only the list of images is wanted, which printList() prints after a frame.
  bool listsOnly() const { return lists_; }
  /// Appends the files that write() will write.
  void appendOutputs(std::vector<OutputFile>& files) const;

  /// Makes the next rendering with these options copy the images; this object outlives the rendering.
  void addTo(host::RenderOptions& options);
  /// After that rendering. Throws engine::Error (bad input) that lists what there is when a dump matches no image.
  void requireMatches() const;
  void printList() const;
  void write() const;

 private:
  bool lists_ = false;
  std::vector<ImageDump> dumps_;
  host::Tapped tapped_;
};

}  // namespace lensgraph::cli
