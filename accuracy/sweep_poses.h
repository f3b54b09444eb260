#pragma once

#include <optional>

#include "accuracy/random.h"
#include "accuracy/scene.h"
#include "base/camera_model.h"

namespace pleinair::accuracy {

/// Where a marker stands; what is not given is drawn.
struct PlaceWanted {
  double side_px = 100.0;
  double tilt_deg = 0.0;
  std::optional<Vec2> centre_px{};  ///< Drawn such that the whole print is in the picture.
  std::optional<double> roll{}, tilt_axis{};
  std::optional<int> number{};
};

MarkerSpec PlaceMarker(const CameraModel& camera, const PlaceWanted& wanted, RandomStream* random);

}  // namespace pleinair::accuracy
