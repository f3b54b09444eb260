#pragma once

// Internal: between the .cc files of this module; not installed.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace pleinair::scene {

/// Where a value and its key are in a TOML text: byte offsets, `end` excluded.
struct TomlEntry {
  std::vector<std::string> keys;  ///< More than one if dotted; none for an item of an array.
  std::size_t key_begin = 0, key_end = 0;
  std::size_t begin = 0, end = 0;
  bool is_array = false, is_table = false;
  std::vector<TomlEntry> items;  ///< Items of an array, entries of an inline table.
};

/// A table under a header, or the top of the text.
struct TomlSection {
  std::vector<std::string> path;  ///< Empty: the top of the text.
  std::size_t end = 0;            ///< After the line of its last entry, or of its header.
  std::vector<TomlEntry> entries = {};
};

/// Returns the sections of a TOML text, in order; the first is the top of the text. The text must
/// be valid TOML. Otherwise some places are wrong, but all are inside the text. Keys are compared
/// as written between quotes, without escapes.
std::vector<TomlSection> LayoutOf(std::string_view text);

}  // namespace pleinair::scene
