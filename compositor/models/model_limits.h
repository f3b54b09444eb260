#pragma once

#include <cstddef>
#include <cstdint>

namespace pleinair::compositor {

// Max. allocations that a hostile or broken file can cause.
inline constexpr std::size_t kMaxVertices = 20'000'000;
inline constexpr std::size_t kMaxTriangles = 40'000'000;
inline constexpr int kMaxTextureSide_px = 16'384;
/// Max. coordinate in a file, and max. distance from the model's origin, in the file's unit. The
/// latter is what a float can hold.
inline constexpr double kMaxCoordinate = 1e10, kMaxExtent = 1e8;
/// From here on, neighbouring floats differ by more than half a millimetre in metres.
inline constexpr double kMinFarCoordinate = 8192.0;
inline constexpr std::uintmax_t kMaxFileBytes = std::uintmax_t{4} << 30;
/// All decompressed streams of a file together: what a file may hold uncompressed.
inline constexpr std::size_t kMaxDecodedBytes = kMaxFileBytes / 2;
/// Morph targets of a mesh.
inline constexpr std::size_t kMaxMorphTargets = 4096;

}  // namespace pleinair::compositor
