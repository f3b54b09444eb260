#pragma once

#include <string>

#include "base/error.h"

namespace pleinair::app {

/// One of several equal parts of a run, from 1: every `count`-th item from the `index`-th.
struct Shard {
  int index = 1, count = 1;
};

/// Parses "2/7"; all for an empty text. Error (input): other text, or an index beyond the count.
Result<Shard> ParseShard(const std::string& text);

}  // namespace pleinair::app
