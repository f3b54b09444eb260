#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace pleinair::architecture {

/// Every .h, .cc and shader below the module folders of `root`; relative paths, sorted.
std::vector<std::filesystem::path> FindSources(const std::filesystem::path& root);

/// One `#include` of a file.
struct Include {
  int line = 0;
  std::string path;  ///< The text between the quotes or angle brackets.
};

/// The include directives of a source text, indented ones included. Comments are skipped.
std::vector<Include> ParseIncludes(std::string_view text);

/// Violations in one file: order of modules, order of the folders inside compositor, and library
/// rules. One line each ("tracker/x.cc:3: includes gl/y.h: tracker may not know gl"). `file` is
/// relative to the root of the source tree, "tracker/x.cc".
std::vector<std::string> FindBreaches(const std::filesystem::path& file, std::string_view text);

/// Violations in every file of FindSources.
std::vector<std::string> FindBreachesBelow(const std::filesystem::path& root);

/// A header and all headers of ours that it includes, directly or indirectly. Paths are relative to
/// the root, in order of first occurrence.
std::vector<std::string> HeadersReached(const std::filesystem::path& root,
                                        const std::string& header);

/// A unit and the units that it includes. A unit is a header with its source, named by their path
/// without extension: "tracker/tracker".
using UnitIncludes = std::map<std::string, std::set<std::string>>;

/// The include graph of the .h and .cc files below the module folders of `root`. A unit's inclusion
/// of its own header is no edge.
UnitIncludes ReadUnitIncludes(const std::filesystem::path& root);

/// Include cycles: the strongly connected components of more than one unit (Tarjan 1972), each in
/// alphabetical order.
std::vector<std::vector<std::string>> FindLoops(const UnitIncludes& includes);

}  // namespace pleinair::architecture
