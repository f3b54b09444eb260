#pragma once

#include <string>

#include "base/error.h"

namespace pleinair::tests {

/// The message for the user; "no error" on success.
template <typename T>
std::string MessageOf(const Result<T>& result) {
  return result ? "no error" : result.error().Message();
}

}  // namespace pleinair::tests
