#pragma once

#include <optional>

#include "accuracy/random.h"
#include "accuracy/scene.h"
#include "base/camera_model.h"

namespace pleinair::accuracy {

/// Requested position of a marker; unset values are drawn at random.
struct PlaceWanted {
  double side_px = 100.0;
  double tilt_deg = 0.0;
  std::optional<Vec2> centre_px{};  ///< Drawn so that the whole marker is in the image.
  std::optional<double> roll{}, tilt_axis{};
  std::optional<int> number{};
};

MarkerSpec PlaceMarker(const CameraModel& camera, const PlaceWanted& wanted, RandomStream* random);

}  // namespace pleinair::accuracy
