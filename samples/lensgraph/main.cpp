// lensgraph: entry, logging, and how errors become one line and an exit code.
//
// Exit codes: 0 done, 1 failed at run time, 2 bad input or usage.
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <cstdio>
#include <exception>
#include <iostream>
#include <new>
#include <string>

#include "engine/error.h"
#include "rendergraph/error.h"
#include "samples/lensgraph/process.h"
#include "samples/lensgraph/subcommands.h"

using namespace lensgraph;

namespace {

constexpr int kFailed = 1;
constexpr int kBadInput = 2;

void setUpLogging() {
  auto logger = spdlog::stderr_color_mt("lensgraph");
  logger->set_pattern("lensgraph: %^%l%$: %v");
  logger->set_level(spdlog::level::warn);
  spdlog::set_default_logger(std::move(logger));
}

/// Control characters become spaces: an error is one line.
std::string onOneLine(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  }
  return text;
}

int guardedRun(int argc, char** argv) {
  try {
    const int code = cli::run(argc, argv);
    std::cout.flush();  // into stdout's buffer, which printf shares
    if (!std::cout || std::fflush(stdout) != 0)
      throw engine::Error("standard output cannot be written", engine::ErrorKind::failed);
    return code;
  } catch (const engine::Error& error) {
    spdlog::error("{}", error.what());
    return error.kind() == engine::ErrorKind::badInput ? kBadInput : kFailed;
  } catch (const rendergraph::GraphError& error) {
    spdlog::error("{}", onOneLine(std::string("render graph: ") + error.what()));
  } catch (const std::bad_alloc&) {
    spdlog::error("out of memory; try a smaller --size");
  } catch (const std::exception& error) {
    spdlog::error("{}", onOneLine(error.what()));
  }
  return kFailed;
}

}  // namespace

int main(int argc, char** argv) {
  cli::setUpProcess();
  setUpLogging();
  return guardedRun(argc, argv);
}
