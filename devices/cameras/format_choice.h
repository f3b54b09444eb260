#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <string>
#include <vector>

#include "devices/cameras/camera.h"

namespace pleinair::devices {

struct FormatChoice {
  PixelFormat format = PixelFormat::kYuyv;
  std::optional<ImageSize> size;
  std::optional<double> rate_hz;
};

/// Chooses the format to request from a device: the user's request, or the defaults of
/// FormatRequest. `where` names the device in messages. Errors: no supported format, or the device
/// lacks the requested one.
Result<FormatChoice> ChooseFormat(const std::vector<FormatDescription>& formats,
                                  const FormatRequest& requested, const std::string& where);

/// Describes each difference between requested and negotiated format.
std::vector<std::string> Differences(const FormatRequest& requested,
                                     const NegotiatedFormat& negotiated);

}  // namespace pleinair::devices
