#pragma once

#include <memory>
#include <vector>

#include "base/camera_model.h"
#include "base/error.h"
#include "base/frames.h"
#include "base/image.h"
#include "compositor/composer.h"
#include "compositor/models/placed_model.h"
#include "session/baked_lighting.h"

namespace pleinair::app {

/// Draws a whole scene, phantoms in their own colors and virtual objects, under the sky of any
/// moment: each picture's light is one product with the daylight coefficients.
class DayRenderer {
 public:
  /// `order`: the scene's light as it was found, with coefficients; its time does not count.
  /// `placed`: the models that its solver was made of. Errors as Composer::Create().
  static Result<std::unique_ptr<DayRenderer>> Create(const CameraModel& camera,
                                                     std::vector<compositor::PlacedModel> placed,
                                                     session::LightingRequest request,
                                                     const compositor::ComposerOptions& options);

  /// Sun and sky on level ground, lux.
  LinearRgb LevelLight(UtcTime time) const;

  /// What a camera with this exposure scale (display-linear value per cd/m²) sees. Nothing of the
  /// marker.
  Result<RgbImage> Render(const Transform<Camera, Marker>& camera_from_marker, UtcTime time,
                          LinearRgb exposure_scale);

 private:
  DayRenderer(const CameraModel& camera, session::LightingRequest request);
  RgbImage Far(const session::BakedLighting& light,
               const Transform<Camera, Marker>& camera_from_marker, LinearRgb exposure_scale) const;

  session::LightingRequest request_;
  int width_, height_;
  std::vector<Vec3> rays_;  // Of the pixels, camera coordinates, unit.
  std::unique_ptr<compositor::Composer> composer_;
};

/// The exposure scale of a camera that sets itself to the light, though not wholly: dusk shows
/// darker than noon. White balance is the brightest moment's and stays, so that a low sun is warm.
LinearRgb ExposureScaleOfDay(LinearRgb level_light, LinearRgb brightest);

}  // namespace pleinair::app
