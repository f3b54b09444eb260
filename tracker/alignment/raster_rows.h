#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <array>
#include <vector>

#include "base/vector.h"
#include "tracker/alignment/marker_raster.h"
#include "tracker/alignment/raster_kernels.h"

namespace pleinair::tracker {

/// Shared by the rasters of markers and of targets. For each row of a window it holds the position
/// on the marker and the samples. A ring buffer of blurred rows is for the blur along columns.
/// Buffers are reused, so that nothing is allocated after the largest window.
class RasterRows {
 public:
  /// Resizes a raster's results to the window.
  static void Resize(const PixelWindow& window, PlaneMap* map, PredictedImage* image,
                     std::vector<RowRange>* ranges);

  /// `marker_from_undistorted`: homography from undistorted pixels to the marker. `pad`: radius of
  /// the blur in pixels; `per_pixel`: samples along each side of a pixel.
  void Start(const Mat3& marker_from_undistorted, const WindowRays& rays, int pad, int per_pixel);

  /// Pixels of a row including the blur's radius on either side, and the distance between rows.
  int count() const { return count_; }
  int stride() const { return stride_; }

  /// Positions on the marker of row y of the window, y from -pad on. Valid until the next call.
  const MapRow& Evaluate(const RasterKernels& kernels, const WindowRays& rays, int y);
  /// Copies the result of Evaluate() to `map` if the window contains the row.
  void Keep(int y, PlaneMap* map) const;

  /// Sample rows in the order of the sampling kernels: row i + j per_pixel for sample i across, j
  /// down.
  float* samples(int row) { return &samples_[static_cast<std::size_t>(row) * stride_]; }
  /// Row of the ring buffer; sample rows count from the first of row -pad on.
  float* blurred(int row) { return &ring_.blurred[InRing(row)]; }
  float* blurred_x(int row) { return &ring_.blurred_x[InRing(row)]; }

  /// Collects the rows of the ring around row `y` of the window, from its column `begin` on.
  void Gather(int y, int begin);
  const float* const* rows() const { return ring_.rows.data(); }
  const float* const* rows_x() const { return ring_.rows_x.data(); }

 private:
  /// Homography from rays to the marker.
  struct Projection {
    float origin_x = 0.0F, origin_y = 0.0F;
    std::array<float, 9> homography{};  ///< From rays relative to the origin.
  };
  /// Blurred rows and their derivatives along x, one per tap of the blur along columns, and
  /// pointers to them in the order of the taps.
  struct Ring {
    int taps = 1;
    std::vector<float> blurred, blurred_x;
    std::vector<const float*> rows, rows_x;
  };
  std::size_t InRing(int row) const { return static_cast<std::size_t>(row % ring_.taps) * stride_; }

  int width_ = 0, pad_ = 0, per_pixel_ = 1, count_ = 0, stride_ = 0;
  Projection projection_;
  MapRow here_{};
  std::vector<float> map_rows_, samples_;
  Ring ring_;
};

}  // namespace pleinair::tracker
