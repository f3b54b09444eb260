#pragma once

#include <optional>

#include "base/frames.h"
#include "base/image.h"
#include "base/vector.h"
#include "sky/sky_model.h"

namespace pleinair::app {

/// How the dome lies in a picture.
enum class SkyProjection {
  /// As one sees it lying on his back, head to the north: the zenith in the centre, north up, east
  /// left; the horizon is the circle that touches the edges; the distance from the centre grows
  /// evenly with the angle from the zenith (equidistant).
  kFisheye,
  /// The whole sphere, twice as wide as high: azimuth from left to right, the zenith's row on top.
  /// With east in the middle it is the map that Blender (x east, y north, z up) and three.js (x
  /// east, y up, z south) expect.
  kLatLong,
};

struct SkyPictureOptions {
  SkyProjection projection = SkyProjection::kFisheye;
  int width_px = 1024;               ///< Height: the same, or half of it for kLatLong (even).
  double centre_azimuth_deg = 90.0;  ///< Of kLatLong.
  /// Draw the sun's disc too, darker towards its limb, its light spread over the pixels that it
  /// touches so that their sum is its illuminance.
  bool disc = false;
  /// Of the ground that fills the lower half of kLatLong: diffuse, lit by sun and sky.
  double ground_albedo = 0.15;
};

/// A picture of light: linear Rec.709, cd/m², three floats a pixel.
using LightImage = Image<float>;

/// Radiance of the ground that a sky lights, the same in every direction.
LinearRgb GroundRadiance(const sky::SkyModel& sky, double albedo);

/// The sky with its ground as a picture, drawn on all processors; the same bytes on any number.
LightImage DrawSky(const sky::SkyModel& sky, const SkyPictureOptions& options);

/// Which way a place in the picture looks, in pixels from the top-left corner (a pixel's centre is
/// at ½); nothing outside the fisheye's circle.
std::optional<Direction<World>> DirectionInPicture(const SkyPictureOptions& options, Vec2 place_px);

/// The inverse; for kFisheye of the upper hemisphere.
Vec2 PlaceInPicture(const SkyPictureOptions& options, Direction<World> direction);

}  // namespace pleinair::app
