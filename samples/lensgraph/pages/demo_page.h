// The page of `lensgraph demo`: what the demo measured, and the page made of it.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace lensgraph::cli {

struct DemoResult {
  std::string technique, title;
  std::string picture, errorPicture;  ///< Files, relative to the page.
  double gpuMs = 0.0, wallMs = 0.0;
  double psnr = 0.0;  ///< dB
  std::optional<double> ssim;
};

struct DemoScene {
  std::string id;  ///< Of the shot file, without extension.
  std::string name;
  std::string reference;  ///< File, relative to the page.
  double referenceWallMs = 0.0;
  int width = 0, height = 0;
  std::vector<DemoResult> results;
};

struct DemoReport {
  std::string device;
  std::string version;
  int referenceSamples = 0;
  std::vector<DemoScene> scenes;
};

std::string demoPage(const DemoReport& report);

/// The same as a table for the terminal.
std::string demoTable(const DemoReport& report);

}  // namespace lensgraph::cli
