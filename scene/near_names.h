#pragma once

// Internal: for messages about unknown names.

#include <string>
#include <string_view>
#include <vector>

namespace pleinair::scene {

/// The names that a misspelt one may mean: the nearest, at most three. Near is within three edits
/// (Levenshtein), and a third of the letters, of the whole name or of its part after the last "/",
/// whatever the case. Costs O(length of `misspelt` x all letters of `names`): keep it short.
std::vector<std::string> NearNames(std::string_view misspelt,
                                   const std::vector<std::string>& names);

}  // namespace pleinair::scene
