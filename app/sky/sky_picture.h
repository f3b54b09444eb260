#pragma once

#include <optional>

#include "base/frames.h"
#include "base/image.h"
#include "base/vector.h"
#include "sky/sky_model.h"

namespace pleinair::app {

/// Projection of the sky dome.
enum class SkyProjection {
  /// Equidistant fisheye, as seen lying on one's back with the head to the north: the zenith in the
  /// centre, north up, east left. The horizon is the circle that touches the edges. The distance
  /// from the centre is proportional to the zenith angle.
  kFisheye,
  /// Latitude-longitude map of the whole sphere, twice as wide as high: azimuth from left to right,
  /// the zenith's row on top. With east in the middle it suits Blender (x east, y north, z up) and
  /// three.js (x east, y up, z south).
  kLatLong,
};

struct SkyPictureOptions {
  SkyProjection projection = SkyProjection::kFisheye;
  int width_px = 1024;               ///< Height: the same, or half of it for kLatLong (even).
  double centre_azimuth_deg = 90.0;  ///< For kLatLong.
  /// Also draw the sun's disc with limb darkening. Its light is distributed over the pixels that it
  /// covers, so that their sum is its illuminance.
  bool disc = false;
  /// Albedo of the ground in the lower half of kLatLong: diffuse, lit by sun and sky.
  double ground_albedo = 0.15;
};

/// An image of radiance: linear Rec.709, cd/m², three floats per pixel.
using LightImage = Image<float>;

/// Radiance of the ground lit by a sky, equal in all directions.
LinearRgb GroundRadiance(const sky::SkyModel& sky, double albedo);

/// Renders the sky with its ground on all processors. The bytes do not depend on their number.
LightImage DrawSky(const sky::SkyModel& sky, const SkyPictureOptions& options);

/// Direction of a position in the image, in pixels from the top-left corner (pixel centres at ½).
/// Nothing outside the fisheye's circle.
std::optional<Direction<World>> DirectionInPicture(const SkyPictureOptions& options, Vec2 place_px);

/// The inverse; for kFisheye only the upper hemisphere.
Vec2 PlaceInPicture(const SkyPictureOptions& options, Direction<World> direction);

}  // namespace pleinair::app
