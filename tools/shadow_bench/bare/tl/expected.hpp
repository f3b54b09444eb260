#pragma once

// Replaces tl::expected by the standard's own (C++23) where only a compiler is installed.

#include <expected>
#include <type_traits>
#include <utility>

namespace tl {

using std::expected;
using std::unexpected;

template <typename E>
std::unexpected<std::decay_t<E>> make_unexpected(E&& error) {
  return std::unexpected<std::decay_t<E>>(std::forward<E>(error));
}

}  // namespace tl
