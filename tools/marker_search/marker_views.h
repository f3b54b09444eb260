#pragma once

#include <vector>

#include "base/image.h"
#include "base/vector.h"
#include "tools/marker_search/random_draws.h"
#include "tracker/alignment/marker_raster.h"
#include "tracker/surf_golay/sg_layout.h"

namespace pleinair::marker_search {

/// How a camera of 600 px of focal length sees a marker, in what light, among what.
struct MarkerView {
  double edge_px = 0.0;        ///< Of the black square, were it not tilted.
  double tilt_rad = 0.0;       ///< Of the print's normal off the line of sight,
  double direction_rad = 0.0;  ///< … about this axis of the print's.
  double roll_rad = 0.0;       ///< Of the print in the image.
  double blur_px = 0.7;
  double noise = 0.0;  ///< Standard deviation, grey levels of 255.
  double ink = 0.04, paper = 0.8, light = 1.0;
  std::uint32_t word = 0;  ///< Printed.
  int texture = -1;        ///< Around it; -1 is even grey.
  int texture_x = 0, texture_y = 0;
  int noise_begin = 0;

  /// From modules of the print to pixels, `centre` being where the print's middle is seen.
  Mat3 PixelsFromModules(Vec2 centre) const;
  /// Anything that scenes have, but for tilt, direction, roll and size.
  void DrawConditions(int textures, RandomDraws* draws);
};

/// Renders views; keeps its memory. The same view of two borders has the same noise,
/// contents and surroundings.
class ViewRenderer {
 public:
  explicit ViewRenderer(const std::vector<GreyImage>& textures);

  /// Into an image of `width`×`height` px.
  void Render(const MarkerView& view, const tracker::sg::Border& border, const Mat3& from_modules,
              int width, int height, GreyImage* image);
  const std::vector<GreyImage>& textures() const { return textures_; }

  /// Modules at each pixel's centre in the last image.
  const tracker::PlaneMap& map() const { return map_; }

 private:
  const std::vector<GreyImage>& textures_;
  std::vector<float> noise_;
  std::vector<std::uint8_t> encoded_;  ///< sRGB of linear light, by its share of 1.
  tracker::MarkerRaster raster_;
  tracker::WindowRays rays_;
  tracker::PlaneMap map_;
  tracker::PredictedImage marker_pattern_;
};

}  // namespace pleinair::marker_search
