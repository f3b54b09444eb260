#pragma once

#include <memory>
#include <vector>

#include "base/vector.h"
#include "tracker/alignment/marker_raster.h"
#include "tracker/picture_target/picture_pyramid.h"

namespace pleinair::tracker {

class RasterRows;
struct RasterKernels;

/// Predicts the camera image of a target, as MarkerRaster does for markers. Each pixel is sampled
/// S×S times from the pyramid level of about its resolution; the samples are convolved with the
/// pixel's square and the blur's Gaussian. The additional blur of the interpolation is symmetric,
/// so it does not bias positions.
class PictureRaster {
 public:
  PictureRaster();
  ~PictureRaster();
  PictureRaster(PictureRaster&&) noexcept;
  PictureRaster& operator=(PictureRaster&&) noexcept;

  /// `target_from_undistorted`: homography from undistorted pixels to target units. `blur_px`:
  /// standard deviation of the blur beyond the pixel's own square, in pixels of the window. `map`
  /// has target units in place of modules. `white` of the result is linear light; it is valid on
  /// the target and one pixel around it, in the columns `ranges` of each row.
  void Render(const PicturePyramid& pyramid, const Mat3& target_from_undistorted,
              const WindowRays& rays, double blur_px, PlaneMap* map, PredictedImage* picture,
              std::vector<RowRange>* ranges);

 private:
  /// Pyramid level, and samples along each side of a pixel.
  struct Sampling {
    int level = 0, per_pixel = 1;
  };
  static Sampling ChooseSampling(const PicturePyramid& pyramid, const Mat3& target_from_undistorted,
                                 const WindowRays& rays, double blur_px);
  void SetKernel(double blur_px, int per_pixel, int* pad);

  const RasterKernels* kernels_;
  std::unique_ptr<RasterRows> rows_;
  std::vector<float> kernel_, kernel_slope_;
};

}  // namespace pleinair::tracker
