#pragma once

// Internal: between the .cc files of this module; not installed.

#include <string>
#include <vector>

#include "devices/cameras/camera.h"

namespace pleinair::devices {

struct PictureChoice {
  PixelFormat format = PixelFormat::kYuyv;
  std::optional<PictureSize> size;
  std::optional<double> rate_hz;
};

/// What to ask a device for: the wish where it is one, else as PictureWish says. `where` names the
/// device in messages. Error: no format that we read, or not the one that is wished.
Result<PictureChoice> ChoosePictures(const std::vector<FormatDescription>& formats,
                                     const PictureWish& wish, const std::string& where);

/// Says where the agreement differs from the wish.
std::vector<std::string> Differences(const PictureWish& wish, const PictureAgreement& agreement);

}  // namespace pleinair::devices
