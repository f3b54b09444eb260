#pragma once

#include <cstddef>
#include <vector>

#include "base/camera_model.h"
#include "base/image.h"
#include "base/vector.h"
#include "devices/cameras/live_camera.h"

namespace pleinair::vm {

/// The first images of the bundled AprilTag recording, for simulated cameras, and the true camera
/// positions.
struct CourtyardFilm {
  CameraModel camera;
  double marker_size_m = 0.0;
  std::vector<GreyImage> pictures;
  std::vector<Vec3> places;  ///< Camera positions in the marker's frame, metres.
};

/// Returns no images, and fails the test, if the recording cannot be read.
CourtyardFilm OpenCourtyardFilm();

/// Index of this image among `pictures`; their count if it is none of them.
std::size_t NumberOf(const GreyImage& grey, const std::vector<GreyImage>& pictures);

/// Tracks and records four frames of a camera that plays the film. Expects each to be one of `sent`
/// (the film's images as the camera delivers them) with a correct pose. The recording must replay
/// to identical poses, stamps and exposures.
void ExpectRightPosesAndTheSameInReplay(devices::LiveCamera* camera, const CourtyardFilm& film,
                                        const std::vector<GreyImage>& sent);

}  // namespace pleinair::vm
