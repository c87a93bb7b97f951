// Checking and writing of files: see output.h.
#include "samples/lensgraph/output.h"

#include <fcntl.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iostream>

#include "engine/error.h"

namespace lensgraph::cli {
namespace {

using std::filesystem::path;

std::string lowerExtension(const path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

path besides(const path& file) {
  path temporary = file;
  temporary += ".part-" + std::to_string(getpid());
  return temporary;
}

void checkExtension(const path& file, std::string_view option, std::span<const std::string_view> extensions) {
  const std::string extension = lowerExtension(file);
  if (extensions.empty() || std::find(extensions.begin(), extensions.end(), extension) != extensions.end()) return;
  std::string known;
  for (const auto each : extensions) known += (known.empty() ? "" : ", ") + std::string(each);
  throw engine::Error({.file = file.string(),
                       .field = std::string(option),
                       .reason = extension.empty() ? "has no extension" : "unknown format " + extension,
                       .remedy = "formats are " + known});
}

}  // namespace

void checkOutput(const path& file, std::string_view option, std::span<const std::string_view> extensions) {
  const auto fail = [&](const std::string& reason, const std::string& remedy) {
    throw engine::Error({.file = file.string(), .field = std::string(option), .reason = reason, .remedy = remedy});
  };
  if (file.empty()) fail("is empty", "name a file");
  checkExtension(file, option, extensions);
  std::error_code code;
  if (std::filesystem::is_directory(file, code)) fail("is a folder", "name a file in it");
  const path folder = file.has_parent_path() ? file.parent_path() : path(".");
  if (!std::filesystem::is_directory(folder, code)) {
    fail("cannot be written: no such folder: " + folder.string(), "make the folder first");
  }
  // Asked by doing it: permissions, read-only file systems and full name tables all answer here.
  const path probe = besides(file);
  const int descriptor = ::open(probe.c_str(), O_CREAT | O_EXCL | O_WRONLY, 0600);
  if (descriptor < 0) fail(std::string("cannot be written: ") + std::strerror(errno), "choose another place");
  ::close(descriptor);
  ::unlink(probe.c_str());
}

void requireDistinct(std::span<const OutputFile> files) {
  for (std::size_t i = 0; i < files.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (files[i].file.empty() || files[i].file.lexically_normal() != files[j].file.lexically_normal()) continue;
      throw engine::Error({.file = files[i].file.string(),
                           .field = files[j].option,
                           .reason = "is the same file as " + files[i].option,
                           .remedy = "choose another"});
    }
  }
}

void warnUnusedExposure(const path& output) {
  if (lowerExtension(output) != ".png") {
    spdlog::warn("{}: --exposure changes only .png; this file keeps the scene's light", output.string());
  }
}

void writeTextFile(const path& file, std::string_view text) {
  if (file == "-") {
    std::cout << text;
    return;
  }
  const path temporary = besides(file);
  std::ofstream stream(temporary, std::ios::binary);
  stream << text;
  stream.close();
  std::error_code code;
  if (stream) std::filesystem::rename(temporary, file, code);
  if (!stream || code) {
    const std::string reason = code ? code.message() : std::strerror(errno);
    std::filesystem::remove(temporary, code);
    throw engine::Error({.file = file.string(), .field = {}, .reason = "cannot be written: " + reason, .remedy = {}},
                        engine::ErrorKind::failed);
  }
}

}  // namespace lensgraph::cli
