#pragma once

#include <cstdint>
#include <vector>

#include "base/camera_model.h"
#include "base/frames.h"
#include "base/image.h"

namespace pleinair::compositor {

/// Which part of a marker's print a frame shows: side × side squares of it, quiet zone included,
/// row by row from the top-left as it is read, 0 covered … 255 as printed.
struct PrintCover {
  int side = 0;
  double print_size_m = 0.0;  ///< Edge of all the squares together.
  std::vector<std::uint8_t> seen;
};

/// Where something real (a hand) is before everything virtual, 0…255, camera pixels: the squares of
/// the print that are covered and, where what covers them has a colour that the print and its
/// surroundings have not, all of that colour that hangs together with them. Empty where nothing
/// covers the print.
///
/// Only colour tells how far something reaches beyond the print: of a thing as grey as the ground
/// (a glove, a shadow) no more than what lies on the print counts.
Image<std::uint8_t> MaskOccluder(ImageView<const std::uint8_t> rgb, const CameraModel& camera,
                                 const Transform<Camera, Marker>& camera_from_marker,
                                 const PrintCover& cover);

/// `background` where the mask is 255, `composed` where it is 0; in place. Same sizes.
void PutInFront(ImageView<const std::uint8_t> background, const Image<std::uint8_t>& mask,
                RgbImage* composed);

}  // namespace pleinair::compositor
