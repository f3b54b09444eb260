#pragma once

#include <cstdint>
#include <vector>

#include "base/camera_model.h"
#include "base/frames.h"
#include "base/image.h"

namespace pleinair::compositor {

/// Which part of a marker's marker a frame shows: side × side squares of it, quiet zone included,
/// row by row from the top-left as it is read, 0 covered … 255 as printed.
struct MarkerVisibility {
  int side = 0;
  double marker_area_size_m = 0.0;  ///< Edge of all the squares together.
  std::vector<std::uint8_t> seen;
};

/// Where something real (a hand) is before everything virtual, 0…255, camera pixels: the squares of
/// the marker that are covered and, where what covers them has a color that the marker and its
/// surroundings have not, all of that color that hangs together with them. Empty where nothing
/// covers the marker.
///
/// Only color tells how far something reaches beyond the marker: of a thing as grey as the ground
/// (a glove, a shadow) no more than what lies on the marker counts.
Image<std::uint8_t> MaskOccluder(ImageView<const std::uint8_t> rgb, const CameraModel& camera,
                                 const Transform<Camera, Marker>& camera_from_marker,
                                 const MarkerVisibility& cover);

/// `background` where the mask is 255, `composed` where it is 0; in place. Same sizes.
void PutInFront(ImageView<const std::uint8_t> background, const Image<std::uint8_t>& mask,
                RgbImage* composed);

}  // namespace pleinair::compositor
