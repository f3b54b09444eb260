#pragma once

#include <cstddef>
#include <string>
#include <utility>

#include "base/error.h"

namespace pleinair::compositor {

/// An error for a glTF file that violates the specification. `where`: the file or a part of it.
inline tl::unexpected<Error> GltfError(const std::string& where, std::string what) {
  return InputError(where, std::move(what), "repair the model or export it again");
}

/// A name of the file for messages and lists: at most 120 bytes, without splitting a UTF-8
/// character.
inline std::string ShortName(const std::string& name) {
  constexpr std::size_t kMaxBytes = 120;
  if (name.size() <= kMaxBytes) return name;
  std::size_t end = kMaxBytes;
  while (end > 0 && (static_cast<unsigned char>(name[end]) & 0xC0U) == 0x80U) --end;
  return name.substr(0, end);
}

/// Returns whether an index of a glTF file refers to one of `count` items. Missing indices are
/// negative.
inline bool IsGltfIndex(int index, std::size_t count) {
  return index >= 0 && static_cast<std::size_t>(index) < count;
}

}  // namespace pleinair::compositor
