#pragma once

// Internal: between the .cc files of this module; not installed.

#include <array>
#include <vector>

#include "base/vector.h"
#include "tracker/alignment/marker_raster.h"
#include "tracker/alignment/raster_kernels.h"

namespace pleinair::tracker {

/// What rasters of prints and of images have in common: where each row of a window looks on the
/// marker, the samples along it, and the ring of blurred rows that the columns' blur works on.
/// Buffers are kept, so that nothing is allocated after the largest window was observed.
class RasterRows {
 public:
  /// Gives a raster's results the window's size.
  static void Resize(const PixelWindow& window, PlaneMap* map, PredictedImage* image,
                     std::vector<RowRange>* ranges);

  /// `marker_from_undistorted`: homography from undistorted pixels to the marker. `pad`: how far
  /// the blur reaches, in pixels; `per_pixel`: samples along each side of a pixel.
  void Start(const Mat3& marker_from_undistorted, const WindowRays& rays, int pad, int per_pixel);

  /// Pixels of a row with the blur's reach on either side, and how far apart rows lie.
  int count() const { return count_; }
  int stride() const { return stride_; }

  /// Where the row y of the window looks, from -pad on. Valid until the next row is asked for.
  const MapRow& Evaluate(const RasterKernels& kernels, const WindowRays& rays, int y);
  /// Puts what Look said down where the window has the row.
  void Keep(int y, PlaneMap* map) const;

  /// Samples j across and i along, as SampleRow kernels have them: rows i + j per_pixel.
  float* samples(int row) { return &samples_[static_cast<std::size_t>(row) * stride_]; }
  /// Of the ring: sample row `row` counts from the first of row -pad on.
  float* blurred(int row) { return &ring_.blurred[InRing(row)]; }
  float* blurred_x(int row) { return &ring_.blurred_x[InRing(row)]; }

  /// The taps' rows of the ring around row `y` of the window, from its column `begin` on.
  void Gather(int y, int begin);
  const float* const* rows() const { return ring_.rows.data(); }
  const float* const* rows_x() const { return ring_.rows_x.data(); }

 private:
  /// Where rays meet the marker.
  struct Projection {
    float origin_x = 0.0F, origin_y = 0.0F;
    std::array<float, 9> homography{};  ///< From rays relative to the origin.
  };
  /// Blurred rows and their derivatives along x, as many as the columns' blur has taps; and
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
