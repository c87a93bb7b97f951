// Reads #include lines, and walks the graphs of modules and folders depth first.
#include "include_graph.h"

#include <algorithm>
#include <fstream>
#include <functional>
#include <set>

namespace lensgraph::structure {

namespace fs = std::filesystem;

namespace {

using Graph = std::map<std::string, std::set<std::string>>;

std::string stemOf(const std::string& path) {
  return fs::path(path).stem().string();
}

/// The quoted name of an #include line; empty for every other line.
std::string includedBy(const std::string& line) {
  static const std::string kStart = "#include \"";
  if (!line.starts_with(kStart)) return {};
  const std::size_t end = line.find('"', kStart.size());
  return line.substr(kStart.size(), end - kStart.size());
}

bool matches(const std::string& pattern, const std::string& folder) {
  if (!pattern.ends_with("/*")) return folder == pattern;
  return folder.starts_with(pattern.substr(0, pattern.size() - 1));
}

/// The row of the folder: its own, else that of the folder above it with "/*".
const std::vector<std::string>* rowOf(const Directions& directions, const std::string& folder) {
  if (const auto own = directions.find(folder); own != directions.end()) return &own->second;
  const auto general = directions.find(folderOf(folder) + "/*");
  return general == directions.end() ? nullptr : &general->second;
}

std::string cycleIn(const Graph& graph) {
  std::set<std::string> finished;
  std::vector<std::string> way;
  std::string found;
  const std::function<bool(const std::string&)> closes = [&](const std::string& node) {
    if (finished.contains(node)) return false;
    if (const auto before = std::ranges::find(way, node); before != way.end()) {
      for (auto step = before; step != way.end(); ++step) found += *step + " -> ";
      found += node;
      return true;
    }
    way.push_back(node);
    if (const auto edges = graph.find(node); edges != graph.end()) {
      if (std::ranges::any_of(edges->second, closes)) return true;
    }
    way.pop_back();
    finished.insert(node);
    return false;
  };
  for (const auto& [node, edges] : graph) {
    if (closes(node)) return found;
  }
  return {};
}

}  // namespace

std::string folderOf(const std::string& path) {
  return fs::path(path).parent_path().generic_string();
}

std::vector<SourceFile> readSources(const fs::path& root, const std::vector<std::string>& folders) {
  std::vector<SourceFile> files;
  std::set<std::string> paths;
  for (const std::string& folder : folders) {
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      const std::string extension = entry.path().extension().string();
      if (extension != ".h" && extension != ".cpp") continue;
      files.push_back({entry.path().lexically_relative(root).generic_string(), {}});
      paths.insert(files.back().path);
    }
  }
  std::ranges::sort(files, {}, &SourceFile::path);
  for (SourceFile& file : files) {
    std::ifstream stream(root / file.path);
    for (std::string line; std::getline(stream, line);) {
      const std::string name = includedBy(line);
      if (name.empty()) continue;
      const std::string beside = (fs::path(folderOf(file.path)) / name).lexically_normal().generic_string();
      if (paths.contains(name))
        file.includes.push_back(name);
      else if (paths.contains(beside))
        file.includes.push_back(beside);
    }
  }
  return files;
}

std::vector<std::string> againstDirections(const std::vector<SourceFile>& files, const Directions& directions) {
  std::vector<std::string> lines;
  std::set<std::string> withoutRow;
  for (const SourceFile& file : files) {
    const std::string folder = folderOf(file.path);
    const std::vector<std::string>* allowed = rowOf(directions, folder);
    if (allowed == nullptr) {
      if (withoutRow.insert(folder).second) lines.push_back(folder + " has no row in the table of directions");
      continue;
    }
    for (const std::string& include : file.includes) {
      const std::string target = folderOf(include);
      const auto names = [&](const std::string& pattern) { return matches(pattern, target); };
      if (target != folder && std::ranges::none_of(*allowed, names)) {
        lines.push_back(file.path + " includes " + include + ", but " + folder + " may not include " + target);
      }
    }
  }
  return lines;
}

std::string moduleOf(const SourceFile& file) {
  // Of the same library: a command of the samples may bear the name of a header of the render graph.
  const auto libraryOf = [](const std::string& path) { return path.substr(0, path.find('/')); };
  const auto header = std::ranges::find_if(file.includes, [&](const std::string& include) {
    return stemOf(include) == stemOf(file.path) && libraryOf(include) == libraryOf(file.path);
  });
  const std::string& name = file.path.ends_with(".cpp") && header != file.includes.end() ? *header : file.path;
  return name.substr(0, name.rfind('.'));
}

std::string cycleOfModules(const std::vector<SourceFile>& files) {
  Graph graph;
  for (const SourceFile& file : files) {
    const std::string module = moduleOf(file);
    for (const std::string& include : file.includes) {
      const std::string other = include.substr(0, include.rfind('.'));
      if (other != module) graph[module].insert(other);
    }
  }
  return cycleIn(graph);
}

std::string cycleOfFolders(const std::vector<SourceFile>& files) {
  Graph graph;
  for (const SourceFile& file : files) {
    for (const std::string& include : file.includes) {
      if (folderOf(include) != folderOf(file.path)) graph[folderOf(file.path)].insert(folderOf(include));
    }
  }
  return cycleIn(graph);
}

}  // namespace lensgraph::structure
