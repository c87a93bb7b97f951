// Which source file includes which, read as text, and what of it breaks a table of directions or closes a cycle.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace lensgraph::structure {

/// A header or source and the files of the tree that it includes. Paths are relative to the root of the tree.
struct SourceFile {
  std::string path;
  std::vector<std::string> includes;
};

/// Reads every .h and .cpp below the given folders of `root`. Includes that name no file among them (of the standard
/// library, of packages, generated ones) are left out.
std::vector<SourceFile> readSources(const std::filesystem::path& root, const std::vector<std::string>& folders);

/// The folder of a path: "a/b/c.h" lies in "a/b".
std::string folderOf(const std::string& path);

/// By folder, the other folders that its files may include. "name/*" stands for every folder below `name` that has no
/// row of its own; in the list of what may be included, it stands for all folders below `name`.
using Directions = std::map<std::string, std::vector<std::string>>;

/// One line for each include that the table does not allow, and for each folder without a row.
std::vector<std::string> againstDirections(const std::vector<SourceFile>& files, const Directions& directions);

/// The module of a file: a header and the source of the same name that includes it, wherever the two lie.
std::string moduleOf(const SourceFile& file);

/// A cycle of modules, or of folders, as "a -> b -> a"; empty when there is none.
std::string cycleOfModules(const std::vector<SourceFile>& files);
std::string cycleOfFolders(const std::vector<SourceFile>& files);

}  // namespace lensgraph::structure
