#pragma once

#include <string>
#include <vector>

#include "devices/cameras/camera.h"

namespace pleinair::devices {

/// A way to cameras, and whether this build has it.
struct CameraBackendState {
  std::string name;
  bool built_in = false;
  std::string trouble;  ///< Why it cannot look for cameras now; empty where it can.
};

struct CameraList {
  std::vector<CameraDescription> cameras;
  std::vector<CameraBackendState> backends;
};

/// Everything that is plugged in, by every backend of this build. A camera that two backends see
/// is listed by both. Aravis looks for GigE cameras by a broadcast on every network interface, so
/// it is asked only where `search_network`.
CameraList ListCameras(bool search_network);

}  // namespace pleinair::devices
