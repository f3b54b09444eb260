#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/camera_image.h"
#include "base/camera_model.h"
#include "base/camera_response.h"
#include "base/error.h"
#include "base/frames.h"
#include "base/image.h"
#include "base/vector.h"
#include "compositor/composer_options.h"
#include "compositor/ink/ink_shape.h"
#include "compositor/lens/camera_motion.h"
#include "compositor/lens/lens_figures.h"
#include "compositor/lens/thin_lens.h"
#include "compositor/light/light_mix.h"
#include "compositor/light/lit_mesh.h"
#include "compositor/light/sun_transmittance_map.h"
#include "compositor/models/animation/model_animation.h"
#include "compositor/models/placed_model.h"
#include "compositor/picture/camera_look.h"
#include "sky/sky_model.h"

namespace pleinair::compositor {

/// Draws the virtual objects of a scene into camera images. Phantoms hide the objects, sun and sky
/// light them. The objects cast shadows on themselves and on the real surfaces that phantoms
/// represent. Uses OpenGL 4.5 without a window, from one thread at a time.
class Composer {
 public:
  /// Errors: no OpenGL 4.5 (system), shaders that do not compile.
  static Result<std::unique_ptr<Composer>> Create(const CameraModel& camera,
                                                  const std::vector<PlacedModel>& scene,
                                                  const ComposerOptions& options);
  virtual ~Composer() = default;

  /// Uses other options for the next images; rebuilds only what they change. Errors as Create().
  virtual Result<void> SetOptions(const ComposerOptions& options) = 0;

  /// Uses another camera response for the next images. Errors as Create().
  virtual Result<void> SetResponse(const CameraResponse& response) = 0;

  /// Moves a placed model relative to its position in the baked lighting: x' = linear x +
  /// translation. The light on it and around it stays the same until SetLight().
  virtual void MoveModel(int placed_model, const Mat3& linear, Vec3 translation_m) = 0;

  /// Changes the shape of a placed model that has a playback, from the next image on. `shape` has
  /// the positions and normals of ModelAnimation::At(). Shadows and the bodies' own light follow at
  /// once. The bodies' effect on the indirect illumination of other surfaces follows within some
  /// images (docs/method/changing-surfaces.md). Other triangles (MeshShape::indices) stay until the
  /// next ones. They have no texture coordinates, and cost about as much as a new light. Ignored
  /// for other models.
  virtual void SetShape(int placed_model, std::span<const MeshShape> shape) = 0;

  /// Samples per rendered pixel that the renderer offers: 4, or its maximum if that is lower.
  virtual int samples() const = 0;
  /// Share of the drawn pixels whose coverage was computed at many places. All images count since
  /// the method of antialiasing was set. 0 for methods that compute none.
  virtual double MixedPixels() const = 0;

  /// Releases the context, so that another thread can draw.
  virtual void LetGo() = 0;

  /// Sets the light of the next images. `lit` is a LightSolver's result for the same scene and
  /// daylight, in which models with a playback have no part. `from_below` is its
  /// RadianceFromBelow(), which glossy surfaces mirror below the horizon.
  virtual Result<void> SetLight(const std::vector<LitMesh>& lit, const sky::SkyModel& daylight,
                                const Mat3& marker_from_world, LinearRgb from_below) = 0;

  /// Changes the strength of sun and sky for the next images, relative to the light of SetLight(),
  /// which starts with a mix of 1. `lit`: as in SetLight(). Errors: no memory.
  virtual Result<void> SetLightMix(const std::vector<LitMesh>& lit, const LightMix& mix) = 0;

  /// Replaces the indirect illumination of the surfaces of SetLight(). Does nothing in scenes with
  /// playbacks. Errors: no memory.
  virtual Result<void> SetAmbient(const std::vector<LitMesh>& lit) = 0;

  /// Moves the sun between two calls of SetLight(). Shadows follow it without jumps. The indirect
  /// illumination, which costs more, stays the same.
  virtual void SetSun(const sky::SkyModel& daylight, const Mat3& marker_from_world) = 0;

  /// Sets the edge of the marker's white margin, where no phantom's color applies.
  virtual void SetMarkerMargin(double board_size_m) = 0;

  /// If true (the default), assume that unmodelled objects such as trees may shade sunlit phantoms.
  /// The sunlight that is present is then measured in each image, and only that is removed. If
  /// nothing shades them, the measurement costs accuracy: dark joints and edges look slightly
  /// shaded.
  virtual void AssumeUnmodelledShadows(bool look) = 0;

  /// Sets what takes a part of the sun besides the scene's own geometry; by default nothing does.
  /// Errors: no memory.
  virtual Result<void> SetSunTransmittance(const SunShade& shade) = 0;

  /// Sets the blur and noise of the camera, which drawn pixels receive. Without a look, drawn
  /// pixels stay sharp and clean. Blur of the rendering itself (half a pixel's width) is not added
  /// again. Noise below two steps of 8 bits is omitted.
  virtual Result<void> SetCameraLook(const std::optional<CameraLook>& look) = 0;

  /// Sets the lens that the next images are seen through; nothing, the default: all is in focus.
  /// Surfaces are then out of focus by their distance, in addition to the blur of SetCameraLook().
  /// Images whose circles of confusion are all below 0.3 pixels have the bytes of those without.
  /// `places`: on the stop, drawn one after another, 1…1024, or kByLayers.
  virtual void SetLens(const std::optional<ThinLens>& lens, int places) = 0;

  /// Sets how the camera moves while the next images are exposed; empty, the default: not at all.
  /// Where its longest streak is 0.3 pixels or more, images are means of views from its poses, with
  /// the lens in the same mean. Views lie half a pixel apart, and are `max_views` at most. Other
  /// images have the bytes of those without. What moves in the scene is drawn at rest.
  virtual void SetMotion(const CameraMotion& motion, int max_views) = 0;

  /// Lays ink on the real surfaces that phantoms represent, from the next image on; the first shape
  /// is the lowest. None, the default: no ink. Real shadows stay on ink, and objects cast theirs on
  /// it. It follows the blur of SetCameraLook(); a lens leaves it sharp. Errors: no memory.
  virtual Result<void> SetInk(std::span<const InkShape> shapes, const Mat3& marker_from_world) = 0;

  /// What the lens has drawn in the last image; camera pixels.
  virtual LensFigures DrawnLens() const = 0;

  /// Updates all that Compose() carries to later images, and draws none. Later images have the same
  /// bytes as after Compose(). Errors as Compose().
  virtual Result<void> SkipImage(const Transform<Camera, Marker>& camera_from_marker) = 0;

  /// Returns the image with the virtual objects in it. `exposure_scale`: display-linear value per
  /// radiance and channel (ExposureEstimate). Pixels that no virtual object affects keep their
  /// bytes.
  virtual Result<RgbImage> Compose(CameraImageView image,
                                   const Transform<Camera, Marker>& camera_from_marker,
                                   LinearRgb exposure_scale) = 0;
};

}  // namespace pleinair::compositor
