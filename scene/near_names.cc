#include "scene/near_names.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <numeric>
#include <optional>
#include <utility>

namespace pleinair::scene {
namespace {

constexpr std::size_t kMaxNames = 3;
constexpr std::size_t kMaxEdits = 3;
constexpr std::size_t kFar = kMaxEdits + 1;

bool SameLetter(char a, char b) {
  return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
}

/// Edit distance: letters to insert, delete or replace (Levenshtein 1966; Wagner & Fischer 1974, by
/// rows).
std::size_t Edits(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (SameLetter(a[i], b[j]) ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, diagonal + 1, row[j] + 1});
    }
  }
  return row.back();
}

/// Edit distance, or nullopt if it exceeds kMaxEdits or a third of the letters: that is another
/// word.
std::optional<std::size_t> EditsOfNear(std::string_view misspelt, std::string_view name) {
  const std::size_t edits = Edits(misspelt, name);
  if (edits > kMaxEdits || 3 * edits > misspelt.size()) return std::nullopt;
  return edits;
}

std::string_view LastPart(std::string_view name) { return name.substr(name.rfind('/') + 1); }

}  // namespace

std::vector<std::string> NearNames(std::string_view misspelt,
                                   const std::vector<std::string>& names) {
  std::vector<std::pair<std::size_t, std::string>> near;
  for (const std::string& name : names) {
    const std::optional<std::size_t> whole = EditsOfNear(misspelt, name);
    const std::optional<std::size_t> last = EditsOfNear(LastPart(misspelt), LastPart(name));
    if (whole || last) near.emplace_back(std::min(whole.value_or(kFar), last.value_or(kFar)), name);
  }
  std::sort(near.begin(), near.end());
  std::vector<std::string> nearest;
  for (auto& [edits, name] : near) {
    if (edits > near.front().first || nearest.size() == kMaxNames) break;
    nearest.push_back(std::move(name));
  }
  return nearest;
}

}  // namespace pleinair::scene
