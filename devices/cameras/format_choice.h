#pragma once

// Internal: between the .cc files of this module; not installed.

#include <string>
#include <vector>

#include "devices/cameras/camera.h"

namespace pleinair::devices {

struct FormatChoice {
  PixelFormat format = PixelFormat::kYuyv;
  std::optional<ImageSize> size;
  std::optional<double> rate_hz;
};

/// What to ask a device for: the wish where it is one, else as FormatRequest says. `where` names
/// the device in messages. Error: no format that we read, or not the one that is wished.
Result<FormatChoice> ChooseFormat(const std::vector<FormatDescription>& formats,
                                  const FormatRequest& requested, const std::string& where);

/// Says where the agreement differs from the wish.
std::vector<std::string> Differences(const FormatRequest& requested,
                                     const NegotiatedFormat& negotiated);

}  // namespace pleinair::devices
