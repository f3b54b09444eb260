#pragma once

#include <memory>
#include <string>

#include "app/drape/draped_map.h"
#include "base/error.h"
#include "base/frames.h"
#include "content/draping/surface_view.h"

namespace pleinair::app {

/// The camera's place in the marker frame, from "tx ty tz qx qy qz qw": a line of a TUM trajectory
/// without its time. Error (input): it is none.
Result<Transform<Marker, Camera>> ParseView(const std::string& text);

/// What the camera sees of the phantoms. Errors: those of ParseView() and ReadCalibration(). A lens
/// with distortion is taken for a pinhole, which the draped heights do not depend on; `warning`
/// then says so.
Result<std::unique_ptr<content::SurfaceView>> ViewOfPhantoms(const content::SurfaceIndex& surface,
                                                             const std::string& view,
                                                             const std::string& calibration,
                                                             const Mat3& marker_from_world,
                                                             std::string* warning);

/// For each piece and vertex whether a phantom stands before it, by rays.
std::vector<std::vector<bool>> HiddenVertices(const content::DrapedPieces& draped,
                                              const content::SurfaceIndex& surface,
                                              const Vec3& camera);

}  // namespace pleinair::app
