#include "app/options/shard_option.h"

#include <charconv>

namespace pleinair::app {

Result<Shard> ParseShard(const std::string& text) {
  Shard shard;
  if (text.empty()) return shard;
  const char* end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, shard.index);
  bool good = first.ec == std::errc() && first.ptr != end && *first.ptr == '/';
  if (good) {
    const auto second = std::from_chars(first.ptr + 1, end, shard.count);
    good = second.ec == std::errc() && second.ptr == end;
  }
  if (good && shard.count >= 1 && shard.index >= 1 && shard.index <= shard.count) return shard;
  return InputError("--shard", "\"" + text + "\" is no part of a whole",
                    "write I/N with I from 1 to N, for example 2/7");
}

}  // namespace pleinair::app
