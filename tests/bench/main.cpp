// rendergraph_bench                         prints the times (all --benchmark_… options of Google Benchmark work)
// rendergraph_bench --json FILE             measures everything and writes it
// rendergraph_bench --techniques FILE       measures the techniques again in such a file, and keeps the rest of it
// rendergraph_bench --table FILE            prints such a file as Markdown
// rendergraph_bench --check TEXT FILE       status 1 unless the text, docs/rendergraph_measured.md, contains that Markdown
#include <benchmark/benchmark.h>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include "quality.h"
#include "speed.h"
#include "tables.h"

using namespace lensgraph;

namespace {

using nlohmann::ordered_json;

std::string readFile(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot read " + path.string() + ": give a file that exists");
  return std::string((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
}

void writeFile(const std::filesystem::path& path, const std::string& text) {
  std::filesystem::path temporary = path;
  temporary += ".part";
  std::ofstream file(temporary, std::ios::binary);
  file << text;
  file.close();
  if (!file) throw std::runtime_error("cannot write " + temporary.string() + ": the folder must exist and have room");
  std::filesystem::rename(temporary, path);
}

ordered_json measureAll(const std::string& command) {
  return {{"what",
           "rendergraph: CPU time per pass (least and median of the repetitions), packing over 200 seeds of 100 "
           "passes, batches against bytes, techniques on the nominal device"},
          {"command", command},
          {"device", "2 CPU cores, shared with other work"},
          {"speed", bench::runSpeed()},
          {"aliasing", bench::aliasingQuality()},
          {"batches", bench::batchesAgainstBytes()},
          {"techniques", bench::techniques()}};
}

void measureTechniquesAgain(const std::filesystem::path& results, const std::string& command) {
  ordered_json all = ordered_json::parse(readFile(results));
  all["techniquesCommand"] = command;
  all["techniques"] = bench::techniques();
  writeFile(results, all.dump(1) + "\n");
}

int check(const std::filesystem::path& tables, const std::filesystem::path& results) {
  const std::string expected = bench::markdown(ordered_json::parse(readFile(results)));
  const std::string text = readFile(tables);
  int status = 0;
  for (std::size_t begin = 0; begin < expected.size();) {
    const std::size_t end = expected.find('\n', begin);
    const std::string row = expected.substr(begin, end - begin);
    begin = end + 1;
    if (text.find(row) != std::string::npos) continue;
    std::fprintf(stderr, "rendergraph_bench: %s lacks the row: %s (print the tables with --table %s)\n",
                 tables.string().c_str(), row.c_str(), results.string().c_str());
    status = 1;
  }
  return status;
}

/// `command`: as it was typed.
int run(const std::vector<std::string>& arguments, const std::string& command) {
  if (arguments.size() == 2 && arguments[0] == "--table") {
    std::fputs(bench::markdown(ordered_json::parse(readFile(arguments[1]))).c_str(), stdout);
    return 0;
  }
  if (arguments.size() == 3 && arguments[0] == "--check") return check(arguments[1], arguments[2]);
  if (arguments.size() == 2 && arguments[0] == "--techniques") {
    measureTechniquesAgain(arguments[1], command);
    return 0;
  }
  bench::registerSpeed();
  if (arguments.size() == 2 && arguments[0] == "--json") {
    writeFile(arguments[1], measureAll(command).dump(1) + "\n");
    return 0;
  }
  if (!arguments.empty()) {
    std::fprintf(stderr, "rendergraph_bench: unknown argument %s; main.cpp lists what there is\n",
                 arguments[0].c_str());
    return 2;
  }
  bench::runSpeed();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  std::string command = "rendergraph_bench";
  for (int i = 1; i < argc; ++i) command += std::string(" ") + argv[i];
  benchmark::Initialize(&argc, argv);  // Takes its own options away.
  try {
    return run({argv + 1, argv + argc}, command);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "rendergraph_bench: %s\n", error.what());
    return 2;
  }
}
