#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace pleinair::architecture {

/// One `#include` of a file.
struct Include {
  int line = 0;
  std::string path;  ///< What stands between the quotes or angle brackets.
};

/// The include directives of a source text, also indented ones; those in comments do not count.
std::vector<Include> ParseIncludes(std::string_view text);

/// Breaches of the order of modules and of the rules about libraries in one file, a line each
/// ("tracker/x.cc:3: includes gl/y.h: tracker may know only base"). `file` is relative to the root
/// of the source tree, "tracker/x.cc".
std::vector<std::string> FindBreaches(const std::filesystem::path& file, std::string_view text);

/// The same for every .h, .cc and shader below the module folders of `root`.
std::vector<std::string> FindBreachesBelow(const std::filesystem::path& root);

/// How many files FindBreachesBelow looks at.
std::size_t CountSources(const std::filesystem::path& root);

}  // namespace pleinair::architecture
