#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "base/vector.h"
#include "tracker/alignment/lens_grid.h"
#include "tracker/marker_pattern.h"

namespace pleinair::tracker {

/// A rectangle of the pixels of an image reduced `2^level` times by averaging squares of pixels.
/// A reduced pixel X has its centre at (X + ½) 2^level - ½ of the image's own pixels.
struct PixelWindow {
  int level = 0;
  int x0 = 0, y0 = 0, width = 0, height = 0;

  bool empty() const { return width <= 0 || height <= 0; }
  std::size_t size() const { return static_cast<std::size_t>(width) * height; }
  double Scale() const { return static_cast<double>(1 << level); }
  /// Pixel of the image at the centre of a reduced pixel.
  double Full(double reduced) const { return (reduced + 0.5) * Scale() - 0.5; }
};

/// Where on a marker the pixels of a window look: modules from the marker's top-left corner.
struct PlaneMap {
  std::vector<float> column, row;         ///< At each pixel's centre.
  std::vector<float> column_x, column_y;  ///< Derivatives by the (reduced) pixel's x and y.
  std::vector<float> row_x, row_y;
};

/// Ideal pixels of a window's pixels, with a border of `kWindowBorder` more on each side, row by
/// row, and a few unused ones behind the last.
struct WindowRays {
  PixelWindow window;
  std::vector<float> x, y;
};
inline constexpr int kWindowBorder = 10;

/// Fills `rays` for a window, without new memory once it was as large.
void LookUpRays(const LensGrid& lens, const PixelWindow& window, WindowRays* rays);

/// The image that a marker makes in a window: the share of white in each pixel's light, and how
/// that changes by the pixel's place.
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

/// Predicts images of prints. Buffers are kept, so that nothing is allocated after the largest
/// window was observed.
///
/// Each pixel is sampled S×S times. A sample holds the marker averaged over a box of the sample's
/// footprint, exact for edges along the marker's axes; the samples are then convolved with the
/// pixel's square and the blur's Gaussian, both at once, separably along the image's axes.
class MarkerRaster {
 public:
  MarkerRaster();
  /// With the kernels to work with, for tests.
  explicit MarkerRaster(const RasterKernels& kernels);
  ~MarkerRaster();
  MarkerRaster(MarkerRaster&&) noexcept;
  MarkerRaster& operator=(MarkerRaster&&) noexcept;

  /// `modules_from_undistorted`: homography from undistorted pixels to modules. `blur_px`: standard
  /// deviation of the blur beyond the pixel's own square, in (reduced) pixels of the window. Beyond
  /// the marker its outermost modules go on.
  void Render(const MarkerPattern& pattern, const Mat3& modules_from_undistorted,
              const WindowRays& rays, double blur_px, PlaneMap* map, PredictedImage* image);

  /// The same, but the image only where the marker is and to a pixel around it: `ranges` says
  /// where, for each of the window's rows; elsewhere it is white.
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
  std::vector<double> below_, primitive_;  ///< Φ(x/σ) and its integral at the kernel's bins' edges.
  std::vector<RowRange> all_;
  /// The marker whose nodes these are.
  std::vector<std::uint8_t> nodes_of_;
  std::vector<std::uint32_t> nodes_;
  std::vector<std::uint32_t> row_nodes_;  ///< The same of single rows.
  std::vector<std::uint8_t> row_modules_;
};

}  // namespace pleinair::tracker
