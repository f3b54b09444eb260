#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/camera_model.h"
#include "base/frames.h"

namespace pleinair::e2e {

/// An S-G marker in a frame, 20 cm wide.
struct ShownMarker {
  int number = 0;
  Transform<Camera, Marker> camera_from_marker;
};

/// Writes a recording of rendered markers, one list per frame at 30 Hz, by a camera without
/// distortion. Its scene.toml has marker 17 as the scene's own; `more` follows that.
void WriteMarkerRecording(const std::filesystem::path& folder, const CameraModel& camera,
                          const std::vector<std::vector<ShownMarker>>& frames,
                          const std::string& more = {});

}  // namespace pleinair::e2e
