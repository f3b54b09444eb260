#pragma once

#include <string>

#include "base/camera_model.h"
#include "base/error.h"
#include "base/image_size.h"

namespace pleinair::devices {

/// A calibration for the frames of a film.
struct FittedCamera {
  CameraModel camera;
  std::string note;  ///< For the user, one sentence; empty: the calibration has the film's size.
};

/// The camera model for images turned clockwise by `quarters` right angles.
CameraModel TurnCamera(const CameraModel& camera, int quarters);

/// Fits a calibration to a film of another size, or of a camera held another way. Equal shapes are
/// scaled: right if the camera scales its frames and does not crop them. A film that is stored
/// lying and shown upright, by `clockwise_deg` of its display matrix, has the calibration of the
/// stored frames turned. Errors (input): other shapes, since the part of the sensor is not known.
Result<FittedCamera> FitCamera(const CameraModel& camera, ImageSize film, int clockwise_deg,
                               const std::string& name);

}  // namespace pleinair::devices
