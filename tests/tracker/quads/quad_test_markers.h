#pragma once

#include <array>
#include <memory>
#include <vector>

#include "base/camera_model.h"
#include "tests/tracker/marker_rendering.h"
#include "tracker/quads/quad_detector.h"

namespace pleinair::tracker {

/// A marker pattern with the outline of the S-G marker: an edge of 40 modules, of which four are
/// rim, and four modules of quiet zone. The interior has random blots and cells that depend on the
/// seed.
std::shared_ptr<const MarkerPattern> OutlinedMarker(unsigned seed);

/// A pinhole camera without distortion, focal length 600 px.
CameraModel Pinhole(int width, int height);

RenderedMarker MarkerAt(const CameraModel& camera, unsigned seed, Vec2 centre_px, double side_px,
                        double tilt_deg = 0.0, double axis_deg = 0.0, double roll_deg = 0.0);

/// RMS corner distance of the nearest quad in pixels; infinite if there is none.
double NearestError(const std::vector<Quad>& quads, const std::array<Vec2, 4>& truth);

}  // namespace pleinair::tracker
