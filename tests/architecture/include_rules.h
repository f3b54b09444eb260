#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace pleinair::architecture {

/// Every .h, .cc and shader below the module folders of `root`, relative to it, in order.
std::vector<std::filesystem::path> FindSources(const std::filesystem::path& root);

/// One `#include` of a file.
struct Include {
  int line = 0;
  std::string path;  ///< What stands between the quotes or angle brackets.
};

/// The include directives of a source text, also indented ones; those in comments do not count.
std::vector<Include> ParseIncludes(std::string_view text);

/// Breaches in one file of the order of modules, of the order of the folders inside compositor and
/// of the rules about libraries, a line each ("tracker/x.cc:3: includes gl/y.h: tracker may not
/// know gl"). `file` is relative to the root of the source tree, "tracker/x.cc".
std::vector<std::string> FindBreaches(const std::filesystem::path& file, std::string_view text);

/// The same for every file of FindSources.
std::vector<std::string> FindBreachesBelow(const std::filesystem::path& root);

/// A header of ours and the headers of ours that it includes, directly or through others; paths
/// from the root of the tree, in the order in which they are met.
std::vector<std::string> HeadersReached(const std::filesystem::path& root,
                                        const std::string& header);

/// A unit and the units that it includes. A unit is a header with its source, named by their path
/// without an ending: "tracker/tracker".
using UnitIncludes = std::map<std::string, std::set<std::string>>;

/// The include graph of the .h and .cc files below the module folders of `root`. A unit that
/// includes its own header has no edge to itself.
UnitIncludes ReadUnitIncludes(const std::filesystem::path& root);

/// Loops of units: the strongly connected components of more than one unit (Tarjan 1972), each in
/// alphabetical order.
std::vector<std::vector<std::string>> FindLoops(const UnitIncludes& includes);

}  // namespace pleinair::architecture
