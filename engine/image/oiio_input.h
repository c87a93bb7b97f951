// A picture in memory, open in OpenImageIO. Private to engine/image.
#pragma once

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "engine/image/image.h"

namespace lensgraph::engine {

/// Opens and reads; every failure, of whatever type, becomes an Error that names the file.
class OiioInput {
 public:
  /// `format`: OpenImageIO's name of it. The bytes outlive this.
  OiioInput(const std::filesystem::path& path, const char* format, std::span<const std::byte> bytes);

  /// Facts of a part.
  const OIIO::ImageSpec& select(size_t part);
  /// Channels `first` up to, not including, `end` of the selected part's data window, interleaved. Integers keep their
  /// value.
  std::vector<float> read(int first, int end);

 private:
  template <class Action>
  auto guarded(Action action);

  std::filesystem::path path_;
  OIIO::Filesystem::IOMemReader reader_;
  std::unique_ptr<OIIO::ImageInput> file_;
  OIIO::ImageSpec spec_;
  int part_ = 0;
};

}  // namespace lensgraph::engine
