// The subcommands: what each is given, and the function that carries it out. Free of the argument parser.
//
// Each function returns the exit code (0, or 1 when validation layers complained) and throws engine::Error or
// rendergraph::GraphError otherwise. Results go to stdout, everything else to stderr.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/scene/viewpoint.h"

namespace lensgraph::cli {

struct GlobalArguments {
  std::string device;       ///< Index or part of the name; empty: the most capable one.
  bool validation = false;  ///< Validation and synchronization validation; a message makes the exit code 1.
  bool verbose = false;
};

struct PictureSize {
  int width = 0, height = 0;  ///< px
};

/// How the technique is chosen: shot file, then configuration file, then technique and settings.
struct TechniqueArguments {
  std::string technique;              ///< Empty: as the files say.
  std::vector<std::string> settings;  ///< "key=value"
  std::optional<std::filesystem::path> config;
};

/// What to find out beside the picture: times, memory, images inside the graph.
struct InspectionArguments {
  std::optional<std::filesystem::path> capture, trace;
  std::optional<int> frames;                ///< Measured after one warm-up frame; kDefaultFrames when absent.
  std::optional<std::string> timing;        ///< "inline" or "isolated"; by the device's type when absent.
  std::vector<std::string> dumps;           ///< "PASS/RESOURCE[mip,layer]=FILE", or "list" alone.
  std::optional<int> framesTimed;           ///< Whole frames to time after the picture; see timedFrames().
  bool json = false;                        ///< Print the report as JSON.
  static constexpr int kDefaultFrames = 5;  ///< Few enough to wait for; enough for a median and its spread.
  bool measures() const { return capture || trace; }
  /// As asked for; otherwise one for a report as JSON, which tells the price of a warm frame, and none for one in words.
  int timedFrames() const { return framesTimed.value_or(json ? 1 : 0); }
};

struct RenderArguments {
  std::filesystem::path shot;
  TechniqueArguments technique;
  std::optional<PictureSize> size;
  std::optional<engine::DrawnFaces> faces;  ///< Instead of the shot's.
  std::optional<double> exposureEv;         ///< PNG only.
  InspectionArguments inspection;
  std::optional<std::filesystem::path> depthOut;
  std::optional<std::filesystem::path> checkpoint;  ///< Of raytraced: kept state, from which it goes on.
  std::filesystem::path output;                     ///< Empty: none asked for.
};
int runRender(const RenderArguments& arguments, const GlobalArguments& global);

/// What the numbers of a depth picture mean; see host::DepthMeaning.
struct DepthArguments {
  std::optional<std::string> kind;          ///< "z", "ray", "disparity" or "normalized".
  std::optional<double> scale;              ///< m per unit.
  std::optional<double> nearest, farthest;  ///< m
  std::optional<std::string> white;         ///< "near" or "far".
};

struct ApplyArguments {
  std::filesystem::path color, depth;
  std::string colorLayer, depthChannel;  ///< Empty: found by their names.
  DepthArguments depthMeaning;
  double fovyDeg = 0.0;
  std::optional<double> apertureRadius;  ///< m
  std::optional<double> focalLengthMm, fStop;
  double focusDistance = 0.0;  ///< m; infinity is legal.
  TechniqueArguments technique;
  std::optional<double> exposureEv;
  InspectionArguments inspection;
  std::filesystem::path output;  ///< Empty: none asked for.
};
int runApply(const ApplyArguments& arguments, const GlobalArguments& global);

struct CompareArguments {
  std::vector<std::filesystem::path> pictures;  ///< At least one.
  std::filesystem::path reference;
  double exposureEv = 0.0;
  bool json = false;
  std::optional<std::filesystem::path> shot;   ///< Whose lens and camera tell where depth of field fails.
  std::optional<std::filesystem::path> depth;  ///< m, through a pinhole; with a shot only. Rendered when absent.
  std::optional<std::filesystem::path> maps;   ///< Folder to write.
  std::optional<std::filesystem::path> page;   ///< HTML file to write.
};
int runCompare(const CompareArguments& arguments, const GlobalArguments& global);

struct GraphArguments {
  std::filesystem::path shot;
  TechniqueArguments technique;
  std::optional<PictureSize> size;
  std::optional<engine::DrawnFaces> faces;         ///< Instead of the shot's.
  std::optional<std::filesystem::path> dot, json;  ///< At least one; "-" is stdout.
};
int runGraph(const GraphArguments& arguments, const GlobalArguments& global);

struct DemoArguments {
  std::filesystem::path output = "out/demo";
  std::optional<std::filesystem::path> scenes;  ///< None: the project's own.
  int width = 480;                              ///< px; the height follows each shot.
  int referenceSamples = 256;                   ///< Lens samples of the reference.
};
int runDemo(const DemoArguments& arguments, const GlobalArguments& global);

struct BenchArguments {
  std::string config;                               ///< A configuration file, or "quick".
  std::filesystem::path output;                     ///< A folder.
  std::vector<std::filesystem::path> shots;         ///< Instead of the configuration's; see findShots().
  std::vector<std::string> programs;                ///< "NAME=PATH"
  std::optional<std::filesystem::path> references;  ///< Folder of rendered references; OUTPUT/references when absent.
  std::string shard;                                ///< "I/N"; empty: all.
  std::optional<int> repeats;                       ///< Instead of the configuration's.
};
int runBench(const BenchArguments& arguments, const GlobalArguments& global);

struct BenchMergeArguments {
  std::vector<std::filesystem::path> folders;  ///< Of all shards.
  std::filesystem::path output;
};
int runBenchMerge(const BenchMergeArguments& arguments);

struct CompareBenchArguments {
  std::filesystem::path before, after;  ///< bench.json, or folders that hold it.
  std::string unit = "none";            ///< "none", "pinhole", "copy" or "accumulationView".
  double timeTolerance = 1.1;           ///< Ratio of times that is still none of a regression, >= 1.
  double psnrTolerance = 0.0;           ///< dB that PSNR may fall, >= 0.
  double ssimTolerance = 0.0;           ///< By which SSIM may fall, >= 0.
  bool mustBeComplete = false;          ///< Whether B must have every result of A.
  bool json = false;
};
int runCompareBench(const CompareBenchArguments& arguments);

struct CaptureViewArguments {
  std::filesystem::path capture, output;  ///< "-" as output is stdout.
};
int runCaptureView(const CaptureViewArguments& arguments);

struct CaptureDiffArguments {
  std::filesystem::path before, after;
  bool json = false;
};
int runCaptureDiff(const CaptureDiffArguments& arguments);

int runTechniques(bool json);
int runDevices(bool json);

/// Parses the command line and runs what it asks for. Throws what the subcommands throw, and engine::Error
/// (with file "command line") for wrong usage.
int run(int argc, char** argv);

}  // namespace lensgraph::cli
