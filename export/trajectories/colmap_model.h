#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "export/trajectories/camera_trajectory.h"

namespace pleinair::exports {

/// The bytes of a sparse model's files in one of COLMAP's forms (its docs, "Output Format"):
/// cameras, images and points3D, each `.txt` or `.bin`.
struct ColmapFiles {
  std::string cameras;
  std::string images;
  std::string points3d;  ///< May be empty.
};

/// A picture of a model: an entry of its `images` file.
struct ColmapPicture {
  std::string where;  ///< File and line or entry, for errors.
  std::string name;
  std::int64_t camera_id = 0;
  Transform<Camera, Reference> camera_from_reference;  ///< As COLMAP tells it.
};

/// A sparse model, whatever form its files have; without what pictures saw and points' tracks.
struct ColmapModel {
  std::string images_file;  ///< For errors.
  std::map<std::int64_t, CameraModel> cameras;
  std::vector<ColmapPicture> pictures;
  std::vector<TrajectoryPoint> points;
};

/// The path of the one camera of a model. COLMAP knows no time: a picture's is its number, which
/// ends its name before the extension, divided by `frame_rate_hz`; where not all have one, their
/// order by name counts.
/// Errors: no pictures, pictures of several cameras or of a camera that is not there, two pictures
/// of one number.
Result<CameraTrajectory> TrajectoryFromColmap(ColmapModel model, double frame_rate_hz);

/// A model with the path's pictures, its camera and its points: known poses, as COLMAP's FAQ wants
/// them for triangulation. Pictures that have no name get `frames/%04d.png` with their place in the
/// path.
/// Errors: the path has no camera.
Result<ColmapModel> ColmapFromTrajectory(const CameraTrajectory& path);

}  // namespace pleinair::exports
