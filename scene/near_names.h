#pragma once

// Internal: used for messages about unknown names.

#include <string>
#include <string_view>
#include <vector>

namespace pleinair::scene {

/// Suggestions for a misspelt name: the nearest `names`, at most three. A name is near if the edit
/// distance (Levenshtein) is at most three and at most a third of the letters, for the whole name
/// or its part after the last "/", case-insensitive. Cost: O(length of `misspelt` × all letters of
/// `names`), so keep it short.
std::vector<std::string> NearNames(std::string_view misspelt,
                                   const std::vector<std::string>& names);

}  // namespace pleinair::scene
