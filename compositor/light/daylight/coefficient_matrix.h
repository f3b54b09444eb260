#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/huge_page_allocator.h"
#include "base/vector.h"

namespace pleinair::compositor {

/// Irradiance per radiance from every sky patch to every vertex, in four planes. The first plane is
/// the direct light, equal in all channels. The others are the reflected light in red, green and
/// blue.
///
/// Each entry has eight bits, relative to the largest of 16 patches in a plane. A hundred thousand
/// vertices take 80 MB; reading them dominates the cost of a product. An entry is accurate to 1/510
/// of the largest of its 16, their sum to 0.1 %
/// (tests/compositor/light/daylight/daylight_coefficients_test.cc).
class CoefficientMatrix {
 public:
  static constexpr int kPatches = 16;  ///< A chunk of columns with its own scales.
  static constexpr int kLanes = 16;    ///< Vertices that are interleaved.
  static constexpr int kPlanes = 4;

  template <typename T>
  using Table = std::vector<T, HugePageAllocator<T>>;

  CoefficientMatrix() = default;
  CoefficientMatrix(std::size_t vertices, int patches);

  std::size_t vertices() const { return vertices_; }
  int patches() const { return patches_; }
  int chunks() const { return (patches_ + kPatches - 1) / kPatches; }

  /// Sets the entries of one vertex in one chunk and plane.
  void Set(std::size_t vertex, int chunk, int plane, std::span<const float, kPatches> values);
  float At(std::size_t vertex, int patch, int plane) const;

  /// Computes the irradiance on the vertices from `first` on, as many as `irradiance` has. It adds
  /// the direct and reflected light of `sky` and the reflected light of `sun`. The shadow maps
  /// provide the sun's direct light. `sky` and `sun` have patches() entries.
  void Multiply(std::span<const LinearRgb> sky, std::span<const LinearRgb> sun,
                std::span<std::array<float, 3>> irradiance, std::size_t first = 0) const;
  /// The same for all vertices, without SIMD.
  void MultiplyScalar(std::span<const LinearRgb> sky, std::span<const LinearRgb> sun,
                      std::span<std::array<float, 3>> irradiance) const;

  // In the layout of memory and file.
  Table<std::uint8_t>& codes() { return codes_; }
  const Table<std::uint8_t>& codes() const { return codes_; }
  Table<float>& scales() { return scales_; }
  const Table<float>& scales() const { return scales_; }

 private:
  std::size_t blocks() const { return (vertices_ + kLanes - 1) / kLanes; }
  /// Index of the tile of 16 × 16 codes, and of its 16 scales.
  std::size_t Tile(std::size_t block, int chunk, int plane) const {
    return (block * static_cast<std::size_t>(chunks()) + static_cast<std::size_t>(chunk)) *
               kPlanes +
           static_cast<std::size_t>(plane);
  }

  std::size_t vertices_ = 0;
  int patches_ = 0;
  Table<std::uint8_t> codes_;  ///< [block][chunk][plane][patch][lane].
  Table<float> scales_;        ///< [block][chunk][plane][lane].
};

}  // namespace pleinair::compositor
