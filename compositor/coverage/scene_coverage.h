#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "compositor/coverage/pixel_pieces.h"
#include "compositor/coverage/screen_triangles.h"

namespace pleinair::compositor {

/// Computes what share of a pixel each piece of surface covers, at up to 64 places of the pixels
/// that edges run through. It needs no graphics card and no more than the geometry. Memory is
/// reused between images.
class SceneCoverage {
 public:
  /// `places`: as SamplePlaces(). `with_samples`: also finds the renderer's samples that show each
  /// piece, for its textures.
  SceneCoverage(int places, bool with_samples);

  /// Draws the meshes, in the order in which they are drawn, at the places of the pixels with
  /// edges. `pieces`: one for each pixel of marks(), by its number. The result does not depend on
  /// the number of processors.
  void Measure(std::span<const DrawnMesh> meshes, const PixelView& view,
               std::vector<PixelPieces>* pieces);

  /// Pixels with edges.
  const PixelMarks& marks() const { return triangles_.marks(); }

 private:
  void MeasureRows(const PixelView& view, int first_row, int last_row, std::size_t band,
                   std::span<PixelPieces> pieces);

  std::size_t count_ = 0, samples_at_ = 0;  // samples_at_: 0 without samples.
  std::vector<float> x_, y_;                // The places, filled up to whole blocks.
  ScreenTriangles triangles_;
  /// Rows of the image that are measured together.
  struct Band {
    std::vector<std::uint32_t> touching;  // Numbers of triangles.
    std::vector<float> nearness;          // At the places of its pixels.
    std::vector<std::uint32_t> numbers;   // Likewise.
  };
  std::vector<Band> bands_;
};

}  // namespace pleinair::compositor
