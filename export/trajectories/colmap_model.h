#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "export/trajectories/camera_trajectory.h"

namespace pleinair::exports {

/// The bytes of a sparse model's files in one of COLMAP's formats (its docs, "Output Format"):
/// cameras, images and points3D, each `.txt` or `.bin`.
struct ColmapFiles {
  std::string cameras;
  std::string images;
  std::string points3d;  ///< May be empty.
};

/// An image of a model: an entry of its `images` file.
struct ColmapPicture {
  std::string where;  ///< File and line or entry, for errors.
  std::string name;
  std::int64_t camera_id = 0;
  Transform<Camera, Reference> camera_from_reference;  ///< As in COLMAP.
};

/// A sparse model in either format, without the images' 2D points and the points' tracks.
struct ColmapModel {
  std::string images_file;  ///< For errors.
  std::map<std::int64_t, CameraModel> cameras;
  std::vector<ColmapPicture> pictures;
  std::vector<TrajectoryPoint> points;
};

/// Returns the trajectory of the only camera of a model. COLMAP has no times: an image's time is
/// its number divided by `frame_rate_hz`. The number ends its name before the extension. If an
/// image has none, the order by name counts. Errors: no images, images of several cameras or of a
/// missing camera, two images with one number.
Result<CameraTrajectory> TrajectoryFromColmap(ColmapModel model, double frame_rate_hz);

/// Returns a model with the trajectory's images, its camera and its points: known poses for
/// triangulation, as described in COLMAP's FAQ. Images without a name are called `frames/%04d.png`,
/// by their index in the trajectory. Errors: the trajectory has no camera.
Result<ColmapModel> ColmapFromTrajectory(const CameraTrajectory& path);

}  // namespace pleinair::exports
