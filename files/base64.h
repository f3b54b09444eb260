#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace pleinair::files {

/// Base64 encoding (RFC 4648) of bytes.
std::string Base64(const std::vector<std::uint8_t>& bytes);

}  // namespace pleinair::files
