// Running the program and making its scenes: see program.h.
#include "program.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <set>

namespace lensgraph::cli_test {
namespace {

using nlohmann::json;
using std::filesystem::path;

/// Every file below a folder.
std::set<std::string> listing(const path& folder) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    names.insert(std::filesystem::relative(entry.path(), folder).string());
  }
  return names;
}

void append(std::string& bytes, const void* data, std::size_t size) {
  bytes.append(static_cast<const char*>(data), size);
}

std::string quadBytes(const QuadOptions& options) {
  // Larger than the view, so that every pixel sees it.
  const float z = -options.depth;
  const float corners[4][3] = {{options.firstX * 20, -20, z}, {20, -20, z}, {20, 20, z}, {-20, 20, z}};
  const float uvs[4][2] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
  const unsigned indices[6] = {0, 1, 2, 0, 2, options.lastIndex};
  std::string bytes;
  append(bytes, corners, sizeof corners);
  append(bytes, uvs, sizeof uvs);
  append(bytes, indices, sizeof indices);
  return bytes;
}

constexpr std::size_t kUvOffset = 48, kIndexOffset = 80, kQuadSize = 104;

json quadJson(const QuadOptions& options) {
  json material = {{"doubleSided", true},
                   {"pbrMetallicRoughness", {{"baseColorFactor", {0.25, 0.5, 0.75, 1.0}}}},
                   {"extensions", {{"KHR_materials_unlit", json::object()}}}};
  json gltf = {
      {"asset", {{"version", "2.0"}}},
      {"extensionsUsed", {"KHR_materials_unlit"}},
      {"scene", 0},
      {"scenes", {{{"nodes", {0}}}}},
      {"nodes", {{{"mesh", 0}}}},
      {"meshes",
       {{{"primitives", {{{"attributes", {{"POSITION", 0}, {"TEXCOORD_0", 1}}}, {"indices", 2}, {"material", 0}}}}}}},
      {"accessors",
       {{{"bufferView", 0},
         {"componentType", 5126},
         {"count", 4},
         {"type", "VEC3"},
         {"min", {-20, -20, -options.depth}},
         {"max", {20, 20, -options.depth}}},
        {{"bufferView", 1}, {"componentType", 5126}, {"count", 4}, {"type", "VEC2"}},
        {{"bufferView", 2}, {"componentType", 5125}, {"count", 6}, {"type", "SCALAR"}}}},
      {"bufferViews",
       {{{"buffer", 0}, {"byteOffset", 0}, {"byteLength", kUvOffset}},
        {{"buffer", 0}, {"byteOffset", kUvOffset}, {"byteLength", kIndexOffset - kUvOffset}},
        {{"buffer", 0}, {"byteOffset", kIndexOffset}, {"byteLength", kQuadSize - kIndexOffset}}}},
      {"buffers", {{{"byteLength", kQuadSize}}}},
  };
  if (options.textured) {
    material["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
    gltf["textures"] = {{{"source", 0}}};
    gltf["images"] = {{{"uri", "texture.png"}}};
  }
  gltf["materials"] = json::array({material});
  return gltf;
}

}  // namespace

std::string contentOf(const path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

Outcome run(const path& folder, const std::vector<std::string>& arguments, const std::function<bool()>& prepare) {
  // Beside the folder, so that the program's own files are all that appear in it.
  const path outFile = folder.string() + ".out", errFile = folder.string() + ".err";
  std::vector<char*> argv = {const_cast<char*>(LENSGRAPH_PROGRAM)};
  for (const auto& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    const int out = open(outFile.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600);
    const int err = open(errFile.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600);
    if (out < 0 || err < 0 || dup2(out, 1) < 0 || dup2(err, 2) < 0 || chdir(folder.c_str()) != 0) _exit(127);
    if (prepare && !prepare()) _exit(126);
    execv(argv[0], argv.data());
    _exit(127);
  }
  int status = 0;
  if (child < 0 || waitpid(child, &status, 0) != child) throw std::runtime_error("the program could not be run");
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), contentOf(outFile), contentOf(errFile)};
}

ProgramTest::ProgramTest() {
  std::string pattern = (std::filesystem::temp_directory_path() / "lensgraph-cli-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder");
  folder_ = pattern;
}

ProgramTest::~ProgramTest() {
  std::error_code code;
  std::filesystem::remove_all(folder_, code);
  std::filesystem::remove(folder_.string() + ".out", code);
  std::filesystem::remove(folder_.string() + ".err", code);
}

path ProgramTest::write(const std::string& name, const std::string& bytes) const {
  const path file = folder_ / name;
  std::ofstream(file, std::ios::binary) << bytes;
  return file;
}

void ProgramTest::writeQuad(const QuadOptions& options) const {
  json gltf = quadJson(options);
  gltf["buffers"][0]["uri"] = "quad.bin";
  write("quad.bin", quadBytes(options));
  write("quad.gltf", gltf.dump(1));
}

void ProgramTest::writeQuadGlb(std::size_t missingBytes) const {
  std::string text = quadJson({}).dump();
  while (text.size() % 4 != 0) text += ' ';
  const std::string binary = quadBytes({});
  const auto append32 = [](std::string& bytes, std::size_t value) {
    const auto word = static_cast<uint32_t>(value);
    append(bytes, &word, sizeof word);
  };
  std::string glb = "glTF";
  append32(glb, 2);
  append32(glb, 12 + 8 + text.size() + 8 + binary.size());
  append32(glb, text.size());
  glb += "JSON" + text;
  append32(glb, binary.size());
  glb += std::string("BIN\0", 4) + binary;
  write("quad.glb", glb.substr(0, glb.size() - std::min(missingBytes, glb.size())));
}

json ProgramTest::shot() const {
  return {{"scene", {{{"path", "quad.gltf"}}}},
          {"camera", {{"position", {0, 0, 0}}, {"target", {0, 0, -1}}, {"fovyDeg", 40}}},
          {"lens", {{"apertureRadius", 0.02}, {"focusDistance", 1.0}}},
          {"resolution", {32, 24}}};
}

std::string ProgramTest::runWell(const std::vector<std::string>& arguments) const {
  const auto outcome = run(arguments);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  return outcome.out;
}

void ProgramTest::expectError(const std::vector<std::string>& arguments, int status,
                              const std::vector<std::string>& parts) const {
  const auto before = listing(folder_);
  const auto outcome = run(arguments);
  EXPECT_EQ(outcome.status, status);
  EXPECT_THAT(outcome.err, testing::StartsWith("lensgraph: error: "));
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  for (const auto& part : parts) EXPECT_THAT(outcome.err, testing::HasSubstr(part));
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(listing(folder_), testing::ContainerEq(before)) << "a file was left behind";
}

}  // namespace lensgraph::cli_test
