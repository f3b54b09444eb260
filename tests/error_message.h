#pragma once

#include <string>

#include "base/error.h"

namespace pleinair::tests {

/// What a person would be told; "no error" where all went well.
template <typename T>
std::string MessageOf(const Result<T>& result) {
  return result ? "no error" : result.error().Message();
}

}  // namespace pleinair::tests
