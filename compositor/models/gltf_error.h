#pragma once

#include <cstddef>
#include <string>
#include <utility>

#include "base/error.h"

namespace pleinair::compositor {

/// That a glTF file (`where`: it, or a part of it) is not as the specification has it.
inline tl::unexpected<Error> GltfError(const std::string& where, std::string what) {
  return InputError(where, std::move(what), "repair the model or export it again");
}

/// Whether an index of a glTF file is one of `count` things; those that are missing are below 0.
inline bool IsGltfIndex(int index, std::size_t count) {
  return index >= 0 && static_cast<std::size_t>(index) < count;
}

}  // namespace pleinair::compositor
