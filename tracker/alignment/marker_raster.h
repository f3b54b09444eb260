#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "base/vector.h"
#include "tracker/alignment/lens_grid.h"
#include "tracker/marker_pattern.h"

namespace pleinair::tracker {

/// A rectangle of pixels of an image reduced `2^level` times by averaging squares of pixels. The
/// reduced pixel X has its centre at (X + ½) 2^level - ½ in pixels of the full image.
struct PixelWindow {
  int level = 0;
  int x0 = 0, y0 = 0, width = 0, height = 0;

  bool empty() const { return width <= 0 || height <= 0; }
  std::size_t size() const { return static_cast<std::size_t>(width) * height; }
  double Scale() const { return static_cast<double>(1 << level); }
  /// Full-image coordinate of the centre of a reduced pixel.
  double Full(double reduced) const { return (reduced + 0.5) * Scale() - 0.5; }
};

/// Position on the marker of each pixel of a window, in modules from the marker's top-left corner.
struct PlaneMap {
  std::vector<float> column, row;         ///< At the pixel's centre.
  std::vector<float> column_x, column_y;  ///< Derivatives by the (reduced) pixel's x and y.
  std::vector<float> row_x, row_y;
};

/// Undistorted pixels of a window's pixels, with a border of `kWindowBorder` on each side, row by
/// row, and a few unused elements after the last.
struct WindowRays {
  PixelWindow window;
  std::vector<float> x, y;
};
inline constexpr int kWindowBorder = 10;

/// Fills `rays` for a window; allocates only if the window is larger than all before.
void LookUpRays(const LensGrid& lens, const PixelWindow& window, WindowRays* rays);

/// Predicted image of a marker in a window: each pixel's share of white, and its derivatives by the
/// pixel's position.
struct PredictedImage {
  std::vector<float> white, white_x, white_y;
};

/// Columns [begin, end) of a row.
struct RowRange {
  int begin = 0, end = 0;
};

struct BlurTaps;
struct MapRow;
struct NodeTable;
struct RasterKernels;
class RasterRows;

/// Predicts images of markers. Buffers are reused, so that nothing is allocated after the largest
/// window.
///
/// Each pixel is sampled S×S times. A sample is the marker averaged over the sample's footprint, a
/// box, exact for edges along the marker's axes. The samples are then convolved with the pixel's
/// square and the blur's Gaussian in one separable pass along the image's axes.
class MarkerRaster {
 public:
  MarkerRaster();
  /// With given kernels, for tests.
  explicit MarkerRaster(const RasterKernels& kernels);
  ~MarkerRaster();
  MarkerRaster(MarkerRaster&&) noexcept;
  MarkerRaster& operator=(MarkerRaster&&) noexcept;

  /// `modules_from_undistorted`: homography from undistorted pixels to modules. `blur_px`: standard
  /// deviation of the blur beyond the pixel's own square, in (reduced) pixels of the window. The
  /// marker's outermost modules are extended beyond its edge.
  void Render(const MarkerPattern& pattern, const Mat3& modules_from_undistorted,
              const WindowRays& rays, double blur_px, PlaneMap* map, PredictedImage* image);

  /// As Render(), but only on the marker and one pixel around it. `ranges` has the columns of each
  /// row; outside them the image is white.
  void RenderMarkerOnly(const MarkerPattern& pattern, const Mat3& modules_from_undistorted,
                        const WindowRays& rays, double blur_px, PlaneMap* map,
                        PredictedImage* image, std::vector<RowRange>* ranges);

 private:
  void RenderRows(const MarkerPattern& pattern, const Mat3& modules_from_undistorted,
                  const WindowRays& rays, double blur_px, bool everywhere, PlaneMap* map,
                  PredictedImage* image, std::vector<RowRange>* ranges);
  /// Samples and blurs along the row; `index` counts rows from the first one of the border.
  void SampleRow(const MapRow& map, const NodeTable& table, const BlurTaps& taps, RowRange sampled,
                 int count, int index);
  void WriteRow(const BlurTaps& taps, int y, RowRange range, int width, PredictedImage* image);
  void SetKernel(double blur_px, int per_pixel, int* pad);
  void SetNodes(const MarkerPattern& pattern);
  int SamplesPerPixel(const MarkerPattern& pattern, const Mat3& modules_from_undistorted,
                      const WindowRays& rays, double blur_px) const;

  const RasterKernels* kernels_;
  std::unique_ptr<RasterRows> rows_;
  std::vector<float> kernel_, kernel_slope_;
  std::vector<double> below_, primitive_;  ///< Φ(x/σ) and its integral at the bin edges of the
                                           ///< kernel.
  std::vector<RowRange> all_;
  /// The marker to which these nodes belong.
  std::vector<std::uint8_t> nodes_of_;
  std::vector<std::uint32_t> nodes_;
  std::vector<std::uint32_t> row_nodes_;  ///< As the above, for single rows.
  std::vector<std::uint8_t> row_modules_;
};

}  // namespace pleinair::tracker
