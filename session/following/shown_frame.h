#pragma once

#include <memory>

#include "base/frames.h"
#include "devices/frame.h"
#include "scene/marker_reflectance.h"

namespace pleinair::session {

/// A frame of a live session, and the marker that it shows, for a thread that reads it.
struct ShownFrame {
  std::shared_ptr<const devices::Frame> frame;
  Transform<Camera, Marker> camera_from_marker;
  scene::MarkerReflectance marker;
};

}  // namespace pleinair::session
