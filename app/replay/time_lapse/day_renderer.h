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
/// time. With daylight coefficients an image needs one matrix-vector product, without them rays are
/// traced for each.
class DayRenderer {
 public:
  /// `request`: the scene's estimated light; its time begins the scene.
  /// `placed`: the models that its solver was built from. `phantoms_cast`: false if no phantom
  /// shades anything, such as level ground alone; the shadow maps then resolve the objects alone.
  /// Errors: as Composer::Create().
  static Result<std::unique_ptr<DayRenderer>> Create(const CameraModel& camera,
                                                     std::vector<compositor::PlacedModel> placed,
                                                     session::LightingRequest request,
                                                     const compositor::ComposerOptions& options,
                                                     bool phantoms_cast = true);

  /// Illuminance of sun and sky on level ground, lux. Under layers of clouds: that of the sunniest
  /// tenth of their area, so that pictures are dark where a cloud shades the scene.
  LinearRgb LevelLight(UtcTime time) const;

  /// Renders the image of a camera with this exposure scale (display-linear value per cd/m²). The
  /// marker is not drawn.
  Result<RgbImage> Render(const Transform<Camera, Marker>& camera_from_marker, UtcTime time,
                          LinearRgb exposure_scale);

 private:
  DayRenderer(const CameraModel& camera, session::LightingRequest request);
  Result<void> ShadeByClouds(const session::BakedLighting& light);
  RgbImage Far(const session::BakedLighting& light,
               const Transform<Camera, Marker>& camera_from_marker, LinearRgb exposure_scale) const;

  session::LightingRequest request_;
  int width_, height_;
  bool phantoms_cast_ = true;
  std::vector<Vec3> rays_;  // Per pixel; camera coordinates, unit.
  std::vector<compositor::PlacedModel> placed_;
  std::unique_ptr<compositor::Composer> composer_;
};

/// Exposure scale of a camera that adapts partly to the light: dusk appears darker than noon. White
/// balance is fixed at the brightest moment, so that a low sun appears warm.
LinearRgb ExposureScaleOfDay(LinearRgb level_light, LinearRgb brightest);

}  // namespace pleinair::app
