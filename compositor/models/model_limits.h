#pragma once

#include <cstddef>
#include <cstdint>

namespace pleinair::compositor {

// Max. allocations that a hostile or broken file can cause.
inline constexpr std::size_t kMaxVertices = 20'000'000;
inline constexpr std::size_t kMaxTriangles = 40'000'000;
inline constexpr int kMaxTextureSide_px = 16'384;
inline constexpr std::uintmax_t kMaxFileBytes = std::uintmax_t{4} << 30;

}  // namespace pleinair::compositor
