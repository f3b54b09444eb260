#pragma once

#include <cstdint>
#include <string_view>

namespace pleinair {

/// The unsigned number whose bytes these are, most significant first; at most eight.
inline std::uint64_t BigEndian(std::string_view bytes) {
  std::uint64_t number = 0;
  for (const char c : bytes) number = number << 8 | static_cast<std::uint8_t>(c);
  return number;
}

}  // namespace pleinair
