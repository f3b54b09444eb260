#pragma once

#include <string>
#include <string_view>

#include "app/paths/camera_path.h"

namespace pleinair::app {

/// A sparse model of COLMAP's in its text form (its docs, "Output Format").
struct ColmapTexts {
  std::string cameras;   ///< cameras.txt
  std::string images;    ///< images.txt
  std::string points3d;  ///< points3D.txt; may be empty.
};

/// The path of the one camera of a model. COLMAP tells camera-from-world (quaternion w first) and
/// knows no time: a picture's is its number, which ends its name before the extension, divided by
/// `frame_rate_hz`; where not all have one, their order by name counts. `folder` is the model's,
/// for errors.
/// Errors: files cut short, numbers that are not finite, quaternions that are no rotation,
/// pictures of several cameras or of a camera that is not there, two pictures of one number.
Result<CameraPath> ParseColmap(const ColmapTexts& texts, const std::string& folder,
                               double frame_rate_hz);

/// A model with the path's pictures, its camera and its points, without tracks: known poses, as
/// COLMAP's FAQ wants them for triangulation. Pictures that have no name get
/// `frames/%04d.png` with their place in the path.
/// Errors: the path has no camera.
Result<ColmapTexts> ColmapFromPath(const CameraPath& path);

}  // namespace pleinair::app
