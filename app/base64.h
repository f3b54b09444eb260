#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace pleinair::app {

/// RFC 4648 base 64.
std::string Base64(const std::vector<std::uint8_t>& bytes);

}  // namespace pleinair::app
