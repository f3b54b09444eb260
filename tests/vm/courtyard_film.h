#pragma once

#include <cstddef>
#include <vector>

#include "base/camera_model.h"
#include "base/image.h"
#include "base/vector.h"
#include "devices/cameras/live_camera.h"

namespace pleinair::vm {

/// The first pictures of the bundled AprilTag recording, for cameras in software to play, and where
/// its camera truly was.
struct CourtyardFilm {
  CameraModel camera;
  double marker_size_m = 0.0;
  std::vector<GreyImage> pictures;
  std::vector<Vec3> places;  ///< Of the camera in the marker's frame, metres; of all pictures.
};

/// Without pictures, and with a test failed, where it cannot be read.
CourtyardFilm OpenCourtyardFilm();

/// Which of these pictures this one is; their count where it is none of them.
std::size_t NumberOf(const GreyImage& grey, const std::vector<GreyImage>& pictures);

/// Tracks and records four frames of a camera that plays the film; expects every one to be one of
/// `sent` (the film's pictures as the camera gives them), its pose to be right, and the recording
/// to replay to the same poses, stamps and exposures, bit by bit.
void ExpectRightPosesAndTheSameInReplay(devices::LiveCamera* camera, const CourtyardFilm& film,
                                        const std::vector<GreyImage>& sent);

}  // namespace pleinair::vm
