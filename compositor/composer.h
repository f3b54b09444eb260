#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "base/camera_model.h"
#include "base/error.h"
#include "base/frames.h"
#include "base/image.h"
#include "base/vector.h"
#include "compositor/composer_options.h"
#include "compositor/light/lit_mesh.h"
#include "compositor/light/sun_transmittance_map.h"
#include "compositor/models/placed_model.h"
#include "compositor/picture/camera_look.h"
#include "sky/sky_model.h"

namespace pleinair::compositor {

/// Draws the virtual objects of a scene into camera pictures: hidden by phantoms, lit by sun and
/// sky, casting shadows on themselves and on the real surfaces that phantoms stand for. OpenGL 4.5
/// without a window; one thread at a time.
class Composer {
 public:
  /// Errors: no OpenGL 4.5 (system), shaders that do not compile.
  static Result<std::unique_ptr<Composer>> Create(const CameraModel& camera,
                                                  const std::vector<PlacedModel>& scene,
                                                  const ComposerOptions& options);
  virtual ~Composer() = default;

  /// Draws by other options from now on; builds anew only what they change. Errors as Create().
  virtual Result<void> SetOptions(const ComposerOptions& options) = 0;

  /// Moves a placed model from where it stood when the light was made: x' = linear x +
  /// translation. The light on it and around it stays, until SetLight().
  virtual void MoveModel(int placed_model, const Mat3& linear, Vec3 translation_m) = 0;

  /// Samples a rendered pixel that edges have: 4, or what the renderer gives where that is less.
  virtual int samples() const = 0;

  /// Lets another thread draw from now on.
  virtual void LetGo() = 0;

  /// The light from now on. `lit` is what a LightSolver made of the same scene and daylight, and
  /// `from_below` its RadianceFromBelow(), which glossy surfaces mirror below the horizon.
  virtual Result<void> SetLight(const std::vector<LitMesh>& lit, const sky::SkyModel& daylight,
                                const Mat3& marker_from_world, LinearRgb from_below) = 0;

  /// Moves the sun itself, between two calls of SetLight: shadows follow it without jumps, while
  /// the light among surfaces, which costs more, stays.
  virtual void SetSun(const sky::SkyModel& daylight, const Mat3& marker_from_world) = 0;

  /// Edge of the white board that the marker is printed on, where no phantom's color counts.
  virtual void SetMarkerMargin(double board_size_m) = 0;

  /// Whether what no phantom stands for, trees say, may shade what the phantoms leave in the sun
  /// (the default): then pictures are asked how much of it is there, and only that is taken away.
  /// Where nothing does, asking costs: dark joints and edges look a little shaded.
  virtual void AssumeUnmodelledShadows(bool look) = 0;

  /// How much of the sun what no phantom stands for leaves to the virtual objects; null: all of it,
  /// as at first. Errors: no memory.
  virtual Result<void> SetSunTransmittance(
      const std::shared_ptr<const SunTransmittanceMap>& sun_transmittance) = 0;

  /// Blur and grain that drawn pixels get from now on, those of the camera's own; nothing: as
  /// sharp and clean as they are drawn. Blur that the drawing has anyway (half a pixel's width) is
  /// not added again, and noise below two steps of 8 bits is left out.
  virtual Result<void> SetCameraLook(const std::optional<CameraLook>& look) = 0;

  /// The picture with the virtual objects in it. `gain`: display-linear value per radiance and
  /// channel (ExposureEstimate). Pixels that no virtual thing touches keep their bytes.
  virtual Result<RgbImage> Compose(ImageView<const std::uint8_t> rgb,
                                   const Transform<Camera, Marker>& camera_from_marker,
                                   LinearRgb exposure_scale) = 0;
};

}  // namespace pleinair::compositor
