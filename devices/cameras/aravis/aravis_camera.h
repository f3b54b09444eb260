#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <vector>

#include "devices/cameras/aravis/aravis_handles.h"
#include "devices/cameras/camera.h"

namespace pleinair::devices {

/// GenICam's name of a pixel format, and ours.
struct AravisFormat {
  ArvPixelFormat theirs;
  PixelFormat ours;
};
std::optional<AravisFormat> AravisFormatOf(ArvPixelFormat theirs);
std::optional<AravisFormat> AravisFormatOf(PixelFormat ours);

std::vector<FormatDescription> AravisFormats(ArvCamera* camera);
std::vector<ControlRange> AravisControls(ArvCamera* camera);
std::vector<ControlResult> LockAravisControls(ArvCamera* camera,
                                              const std::vector<ControlRequest>& control_requests);

}  // namespace pleinair::devices
