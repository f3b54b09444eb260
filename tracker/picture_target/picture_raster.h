#pragma once

#include <memory>
#include <vector>

#include "base/vector.h"
#include "tracker/alignment/marker_raster.h"
#include "tracker/picture_target/picture_pyramid.h"

namespace pleinair::tracker {

class RasterRows;
struct RasterKernels;

/// Predicts what a camera sees of a target's picture, as MarkerRaster does of a marker of modules:
/// each pixel is sampled S×S times from the level of the pyramid that has about its resolution, and
/// the samples are convolved with the pixel's square and the blur's Gaussian. What the
/// interpolation blurs in addition is even to all sides, so that it moves nothing.
class PictureRaster {
 public:
  PictureRaster();
  ~PictureRaster();
  PictureRaster(PictureRaster&&) noexcept;
  PictureRaster& operator=(PictureRaster&&) noexcept;

  /// `target_from_undistorted`: homography from undistorted pixels to target units. `blur_px`:
  /// standard deviation of the blur beyond the pixel's own square, in pixels of the window. `map`
  /// has target units for modules. The picture's `white` is linear light and is right where the
  /// target is and to a pixel around it; `ranges` says where, for each of the window's rows.
  void Render(const PicturePyramid& pyramid, const Mat3& target_from_undistorted,
              const WindowRays& rays, double blur_px, PlaneMap* map, PredictedImage* picture,
              std::vector<RowRange>* ranges);

 private:
  /// From which level, and how many samples along each side of a pixel.
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
