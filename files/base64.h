#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace pleinair::files {

/// RFC 4648 base 64.
std::string Base64(const std::vector<std::uint8_t>& bytes);

}  // namespace pleinair::files
