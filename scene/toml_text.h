#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace pleinair::scene {

/// A new value of one key in a TOML text.
struct TomlChange {
  std::string table;      ///< Name of [table] or [[table]]; empty: the top of the file.
  std::size_t index = 0;  ///< Which one of [[table]], from 0.
  std::string key;
  std::string value;  ///< As TOML: a number, a text in quotes, or an array of these.
  /// Numbers in the text that differ from new ones by at most this stay as they are written.
  double tolerance = 0.0;
  std::string replaces = {};  ///< Another key, whose place the new key takes if it is in the text.
};

/// Returns a TOML text with changed values. All other bytes stay: comments, order, blank lines,
/// line ends and other keys. An array of the same length keeps the items that do not differ, with
/// their comments. A missing key is added at the end of its table, a missing [table] at the end of
/// the text. Tables may be written under headers, inline, or with dotted keys. Errors, located in
/// `name`: the text is not TOML, before or afterwards; a [[table]] with this index is missing.
Result<std::string> ChangeToml(std::string_view text, const std::string& name,
                               const std::vector<TomlChange>& changes);

}  // namespace pleinair::scene
