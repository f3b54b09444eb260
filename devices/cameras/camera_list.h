#pragma once

#include <string>
#include <vector>

#include "devices/cameras/camera.h"

namespace pleinair::devices {

/// A camera backend, and whether this build has it.
struct CameraBackendState {
  std::string name;
  bool built_in = false;
  std::string trouble;  ///< Why it cannot list cameras now; empty if it can.
};

struct CameraList {
  std::vector<CameraDescription> cameras;
  std::vector<CameraBackendState> backends;
};

/// Lists the connected cameras of every backend in this build. A camera that two backends support
/// is listed twice. Aravis searches for GigE cameras by a broadcast on every network interface, so
/// it is used only if `search_network` is true.
CameraList ListCameras(bool search_network);

}  // namespace pleinair::devices
