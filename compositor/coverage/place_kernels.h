#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace pleinair::compositor {

/// A triangle at one pixel. Functions of a place are `[0] + x [1] + y [2]`, where (x, y) is the
/// place's distance from the pixel's center, in pixels.
struct TriangleAtPixel {
  using Plane = std::array<float, 3>;
  std::array<Plane, 3> edges;       ///< Positive inside.
  std::array<bool, 3> is_tested{};  ///< False: the whole pixel is inside of this edge.
  /// Whether places on the edge are inside: so for one of two triangles with a common edge.
  std::array<bool, 3> has_edge{};
  Plane nearness{};                       ///< 1 / depth, 1/m.
  float nearest = 0.0F, farthest = 0.0F;  ///< Bounds of the nearness within the triangle.
  float limit = 0.0F;                     ///< Nearer places are not drawn.
  std::uint32_t number = 0;
};

/// What the places of a pixel show. Arrays of a multiple of kPlaceBlock.
struct PlacesOfPixel {
  std::span<const float> x, y;         ///< Distances from the pixel's center, in pixels.
  std::span<float> nearness;           ///< 0 where nothing is seen.
  std::span<std::uint32_t> triangles;  ///< Their numbers.
};
inline constexpr int kPlaceBlock = 16;

/// Surfaces nearer to one another than this share of their distance are one; the one drawn first is
/// seen. Depth has 24 bits.
inline constexpr float kSameDepth = 4e-6F;

/// Draws the triangle to the places that it covers, where nothing nearer has been drawn.
using DrawAtPlaces = void (*)(const TriangleAtPixel& triangle, const PlacesOfPixel& places);
DrawAtPlaces ScalarDrawAtPlaces();
/// The fastest implementation for this machine.
DrawAtPlaces FastestDrawAtPlaces();

}  // namespace pleinair::compositor
