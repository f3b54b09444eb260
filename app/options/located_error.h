#pragma once

#include <string>
#include <utility>

#include "base/error.h"

namespace pleinair::app {

/// Returns `error` with the location `where`, an argument or file, unless it already has one.
inline tl::unexpected<Error> LocatedError(Error error, const std::string& where) {
  if (error.where.empty()) error.where = where;
  return tl::make_unexpected(std::move(error));
}

}  // namespace pleinair::app
