// Reading with OpenImageIO: see oiio_input.h.
//
// OpenImageIO is asked for raw values: alpha is never multiplied for us (oiio:UnassociatedAlpha) and no colour space is
// converted.
#include "engine/image/oiio_input.h"

#include <algorithm>
#include <cstdint>
#include <exception>
#include <new>
#include <string>

#include "engine/image/image_format.h"

namespace lensgraph::engine {

template <class Action>
auto OiioInput::guarded(Action action) {
  try {
    return action();
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    failImage(path_, std::string("is damaged or truncated: ") + error.what());
  }
}

OiioInput::OiioInput(const std::filesystem::path& path, const char* format, std::span<const std::byte> bytes)
    : path_(path), reader_(const_cast<std::byte*>(bytes.data()), bytes.size()) {
  guarded([&] {
    file_ = OIIO::ImageInput::create(format);
    if (!file_) failImage(path_, "cannot be read: " + OIIO::geterror(), {}, ErrorKind::failed);
    file_->set_ioproxy(&reader_);
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);
    if (!file_->open(path_.string(), spec_, config)) {
      failImage(path_, "is damaged or truncated: " + file_->geterror());
    }
  });
}

const OIIO::ImageSpec& OiioInput::select(size_t part) {
  guarded([&] {
    part_ = static_cast<int>(part);
    if (!file_->seek_subimage(part_, 0)) failImage(path_, "is damaged or truncated: " + file_->geterror());
    spec_ = file_->spec();
  });
  return spec_;
}

std::vector<float> OiioInput::read(int first, int end) {
  return guarded([&] {
    const auto count =
        static_cast<size_t>(spec_.width) * static_cast<size_t>(spec_.height) * static_cast<size_t>(end - first);
    const auto readAs = [&](OIIO::TypeDesc type, void* target) {
      if (!file_->read_image(part_, 0, first, end, type, target)) {
        failImage(path_, "is damaged or truncated: " + file_->geterror());
      }
    };
    std::vector<float> samples(count);
    const OIIO::TypeDesc type = spec_.channelformat(first);
    if (type != OIIO::TypeDesc::UINT32) {
      readAs(OIIO::TypeDesc::FLOAT, samples.data());
      return samples;
    }
    // OpenImageIO would divide integers by the largest there is.
    std::vector<uint32_t> integers(count);
    readAs(type, integers.data());
    std::ranges::transform(integers, samples.begin(), [](uint32_t value) { return static_cast<float>(value); });
    return samples;
  });
}

}  // namespace lensgraph::engine
