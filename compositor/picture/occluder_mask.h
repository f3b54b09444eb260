#pragma once

#include <cstdint>
#include <vector>

#include "base/camera_model.h"
#include "base/frames.h"
#include "base/image.h"

namespace pleinair::compositor {

/// Visible part of the marker in a frame. It has side × side squares, quiet zone included, row by
/// row from the marker's top-left. Values: 0 covered … 255 as printed.
struct MarkerVisibility {
  int side = 0;
  double marker_area_size_m = 0.0;  ///< Edge of all squares together.
  std::vector<std::uint8_t> seen;
};

/// Masks real objects, such as a hand, in front of everything virtual: 0…255, camera pixels. The
/// mask has the covered squares of the marker. It also has the connected area of the occluder's
/// color, if the marker and its surroundings do not have that color. The mask is empty where
/// nothing covers the marker.
///
/// Only color shows how far an occluder extends beyond the marker. For an occluder as grey as the
/// ground (a glove, a shadow), only its part on the marker counts.
Image<std::uint8_t> MaskOccluder(ImageView<const std::uint8_t> rgb, const CameraModel& camera,
                                 const Transform<Camera, Marker>& camera_from_marker,
                                 const MarkerVisibility& cover);

/// Copies `background` into `composed` where the mask is 255, keeps `composed` where it is 0, in
/// place. All have the same size.
void PutInFront(ImageView<const std::uint8_t> background, const Image<std::uint8_t>& mask,
                RgbImage* composed);

}  // namespace pleinair::compositor
