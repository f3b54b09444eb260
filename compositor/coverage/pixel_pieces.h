#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "compositor/coverage/place_kernels.h"
#include "compositor/coverage/screen_triangles.h"

namespace pleinair::compositor {

/// The pieces of surface that a pixel shows, as shaders/covered_pixels.frag reads them. Weights are
/// shares of the pixel in units of 1/64, eight bits each, from the lowest on.
struct PixelPieces {
  /// Up to four numbers of triangles of objects; 0 from the first missing one on. Each has the
  /// renderer's samples that show its piece: VisibleTriangle of
  /// shaders/visibility_buffer_layout.glsl.
  std::array<std::uint32_t, 4> objects{};
  /// The same without samples, for real surfaces whose light may change.
  std::array<std::uint32_t, 4> real{};
  std::uint32_t object_weights = 0, real_weights = 0;
  /// The least kind of a visible triangle, or kNoKind.
  std::uint32_t object_kind = kNoKind, real_kind = kNoKind;

  static constexpr std::uint32_t kNoKind = 3;
  /// Instead of a kind of object: alpha decides what is seen, so that the renderer's samples stay.
  static constexpr std::uint32_t kKeepSamples = 7;
};
inline constexpr int kWeightOfPixel = 64;
inline constexpr std::uint32_t kNoTriangle = ~0U;

/// Groups what the places of a pixel show into pieces of surface, by the rules of
/// shaders/object_pixels.frag and affected_pixels.frag. The fifth largest and smaller ones are
/// counted with the piece of the same surface, or else with the largest. One object sorts many
/// pixels.
class PieceSorter {
 public:
  /// `triangles` must outlive the sorter. `pixel_angle`: PixelView::PixelAngle().
  PieceSorter(std::span<const ScreenTriangle> triangles, double pixel_angle)
      : triangles_(triangles), pixel_angle_(static_cast<float>(pixel_angle)) {}

  /// `places`: numbers of the triangles, or kNoTriangle. The first `count` have equal weights;
  /// `count` is a power of two and kWeightOfPixel at most. `samples_at`: index of the first of the
  /// renderer's four samples among the places; 0: none.
  PixelPieces Sort(const PlacesOfPixel& places, std::size_t count, std::size_t samples_at);

 private:
  /// A triangle in a pixel.
  struct FoundTriangle {
    std::uint32_t number = 0;
    int places = 0;
    std::size_t piece = 0;
  };
  /// A piece of surface.
  struct Piece {
    const ScreenTriangle* first = nullptr;
    float depth_m = 0.0F, reach_m = 0.0F;
    int places = 0;
    std::uint32_t samples = 0;

    bool Has(const ScreenTriangle& triangle, float at_m) const;
  };
  /// Pieces of objects, or of real surfaces, as PixelPieces has them.
  struct Written {
    std::array<std::uint32_t, 4> ids{};
    std::uint32_t weights = 0, kind = PixelPieces::kNoKind;
  };

  void Add(std::uint32_t number, float nearness);
  FoundTriangle* Find(std::uint32_t number);
  std::size_t PieceOf(const ScreenTriangle& triangle, float nearness);
  std::uint32_t RepresentativeOf(std::size_t piece) const;
  Written Write(bool objects, int weight) const;

  std::span<const ScreenTriangle> triangles_;
  float pixel_angle_ = 0.0F;
  // The current pixel.
  bool has_holes_ = false;
  std::size_t count_ = 0, piece_count_ = 0;
  std::size_t latest_ = 0;  // The triangle that was found last.
  std::array<FoundTriangle, kWeightOfPixel> found_;
  std::array<Piece, kWeightOfPixel> pieces_;
};

}  // namespace pleinair::compositor
