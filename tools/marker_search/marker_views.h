#pragma once

#include <vector>

#include "base/image.h"
#include "base/vector.h"
#include "tools/marker_search/random_draws.h"
#include "tracker/alignment/marker_raster.h"
#include "tracker/surf_golay/sg_layout.h"

namespace pleinair::marker_search {

/// How a camera with a focal length of 600 px sees a marker: pose, light and surroundings.
struct MarkerView {
  double edge_px = 0.0;        ///< Edge of the black square without tilt.
  double tilt_rad = 0.0;       ///< Angle between the marker's normal and the line of sight.
  double direction_rad = 0.0;  ///< Direction of the tilt axis in the marker's plane.
  double roll_rad = 0.0;       ///< Roll of the marker in the image.
  double blur_px = 0.7;
  double noise = 0.0;  ///< Standard deviation, grey levels of 255.
  double ink = 0.04, paper = 0.8, light = 1.0;
  std::uint32_t word = 0;  ///< Codeword on the marker.
  int texture = -1;        ///< Texture around the marker; -1: uniform grey.
  int texture_x = 0, texture_y = 0;
  int noise_begin = 0;

  /// Homography from marker modules to pixels; `centre` is the image of the marker's centre.
  Mat3 PixelsFromModules(Vec2 centre) const;
  /// Draws all random conditions except tilt, direction, roll and size.
  void DrawConditions(int textures, RandomDraws* draws);
};

/// Renders views and reuses its buffers. The same view of two borders has the same noise, contents
/// and surroundings.
class ViewRenderer {
 public:
  explicit ViewRenderer(const std::vector<GreyImage>& textures);

  /// Renders into an image of `width`×`height` px.
  void Render(const MarkerView& view, const tracker::sg::Border& border, const Mat3& from_modules,
              int width, int height, GreyImage* image);
  const std::vector<GreyImage>& textures() const { return textures_; }

  /// Marker coordinates, in modules, at each pixel centre of the last image.
  const tracker::PlaneMap& map() const { return map_; }

 private:
  const std::vector<GreyImage>& textures_;
  std::vector<float> noise_;
  std::vector<std::uint8_t> encoded_;  ///< sRGB value of linear light 0…1.
  tracker::MarkerRaster raster_;
  tracker::WindowRays rays_;
  tracker::PlaneMap map_;
  tracker::PredictedImage marker_pattern_;
};

}  // namespace pleinair::marker_search
