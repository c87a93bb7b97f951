// Options that several subcommands share, and what each subcommand adds to the parser. With the files of this folder the
// only user of CLI11.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "samples/lensgraph/subcommands.h"

namespace lensgraph::cli {

/// Carries out a subcommand whose words have been parsed; returns the exit code.
using Action = std::function<int(const GlobalArguments&)>;

/// Throws engine::Error about the command line.
[[noreturn]] void failUsage(const std::string& field, const std::string& reason, const std::string& remedy);
/// Throws engine::Error unless the value is finite.
void requireFinite(const std::string& field, double value);

// Each adds options that write into the given object, which outlives the parser.
void addSize(CLI::App& app, std::optional<PictureSize>& size);
void addFaces(CLI::App& app, std::optional<engine::DrawnFaces>& faces);
void addExposure(CLI::App& app, std::optional<double>& exposure);
void addTechnique(CLI::App& app, TechniqueArguments& technique, bool required);
void addInspection(CLI::App& app, InspectionArguments& inspection);

/// Throws engine::Error unless there is an output; it may be left out only where nothing but a list is asked for.
void requireOutput(const std::string& subcommand, const std::filesystem::path& output,
                   const InspectionArguments& inspection);

// Each adds one subcommand with its options.
Action addRender(CLI::App& app);
Action addApply(CLI::App& app);
Action addGraph(CLI::App& app);
Action addDemo(CLI::App& app);
Action addCompare(CLI::App& app);
Action addBench(CLI::App& app);
Action addBenchMerge(CLI::App& app);
Action addCompareBench(CLI::App& app);
Action addCaptureView(CLI::App& app);
Action addCaptureDiff(CLI::App& app);

}  // namespace lensgraph::cli
